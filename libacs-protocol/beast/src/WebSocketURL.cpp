#include "WebSocketURL.hpp"

#include <acs/core/ECoreError.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/core/ShownURL.hpp>

#include <algorithm>
#include <cstdint>

namespace ACS::ProtocolBeast
{

namespace
{

constexpr std::string_view PLAIN = "ws://";
constexpr std::string_view SECURE = "wss://";
constexpr std::string_view PLAIN_PORT = "80";
constexpr std::string_view SECURE_PORT = "443";

tl::unexpected<Core::Error> Refuse(std::string_view text)
{
    return Core::Fail(
        Core::ECoreError::OutOfRange,
        "url",
        "ws://host[:port][/path] or wss://host[:port][/path]",
        Core::QuoteForError(Core::MakeShownURL(text)));
}

bool IsPort(std::string_view text)
{
    return Core::ParseNumberOrNull<std::uint16_t>(text).value_or(0) != 0;
}

/// What no URL may have anywhere: it would end up in the lines of the HTTP request.
bool HasForbiddenByte(std::string_view text)
{
    return std::any_of(text.begin(), text.end(), [](char byte) {
        return static_cast<unsigned char>(byte) <= ' ' || byte == '\x7F';
    });
}

} // namespace

Core::Result<WebSocketURL> ParseWebSocketURL(std::string_view text)
{
    const bool bSecure = text.starts_with(SECURE);
    if ((!bSecure && !text.starts_with(PLAIN)) || HasForbiddenByte(text))
    {
        return Refuse(text);
    }
    const std::string_view rest = text.substr(bSecure ? SECURE.size() : PLAIN.size());
    const std::size_t authorityEnd = std::min(rest.find_first_of("/?#"), rest.size());
    const std::string_view authority = rest.substr(0, authorityEnd);
    std::string_view target = rest.substr(authorityEnd);
    target = target.substr(0, target.find('#'));

    std::string_view host = authority;
    std::string_view port;
    const std::size_t bracket = authority.find(']');
    const std::size_t colon = authority.find(':', bracket == std::string_view::npos ? 0 : bracket);
    if (colon != std::string_view::npos)
    {
        host = authority.substr(0, colon);
        port = authority.substr(colon + 1);
    }
    if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    {
        host = host.substr(1, host.size() - 2);
    }
    if (host.empty() || host.find_first_of("@[]") != std::string_view::npos
        || (colon != std::string_view::npos && !IsPort(port)))
    {
        return Refuse(text);
    }
    const std::string_view defaultPort = bSecure ? SECURE_PORT : PLAIN_PORT;
    WebSocketURL url;
    url.bSecure = bSecure;
    url.host = host;
    url.port = port.empty() ? defaultPort : port;
    url.hostHeader = authority;
    url.target = target.empty() || target.front() != '/' ? "/" + std::string(target) : std::string(target);
    return url;
}

} // namespace ACS::ProtocolBeast

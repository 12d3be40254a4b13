#include <acs/core/ECoreError.hpp>
#include <acs/protocol_beast/HttpHeaders.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

namespace
{

/// A token of RFC 9110, section 5.6.2.
bool IsToken(std::string_view text)
{
    constexpr std::string_view ALLOWED = "!#$%&'*+-.^_`|~0123456789"
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return !text.empty() && text.find_first_not_of(ALLOWED) == std::string_view::npos;
}

bool IsFieldValue(std::string_view text)
{
    return std::none_of(text.begin(), text.end(), [](char byte) {
        const auto code = static_cast<unsigned char>(byte);
        return (code < ' ' && byte != '\t') || byte == '\x7F';
    });
}

std::string MakeLower(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return lower;
}

bool IsMadeByUpgrade(std::string_view name)
{
    constexpr std::array<std::string_view, 5> MADE =
        {"host", "connection", "upgrade", "content-length", "transfer-encoding"};
    const std::string lower = MakeLower(name);
    return lower.starts_with("sec-websocket-") || std::find(MADE.begin(), MADE.end(), lower) != MADE.end();
}

} // namespace

Core::Result<void> CheckHttpHeaders(const HttpHeaders& headers)
{
    for (const auto& [name, value] : headers)
    {
        if (!IsToken(name))
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                "headers",
                "the name of an HTTP header",
                Core::QuoteForError(name));
        }
        if (IsMadeByUpgrade(name))
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                "headers." + name,
                "a header that the WebSocket upgrade does not make itself");
        }
        if (!IsFieldValue(value))
        {
            return Core::Fail(Core::ECoreError::OutOfRange, "headers." + name, "a value without control characters");
        }
    }
    return {};
}

const std::string* FindHeaderOrNull(const HttpHeaders& headers, std::string_view name)
{
    const std::string* found = nullptr;
    for (const auto& [other, value] : headers)
    {
        if (MakeLower(other) != MakeLower(name))
        {
            continue;
        }
        if (found != nullptr)
        {
            return nullptr;
        }
        found = &value;
    }
    return found;
}

Core::Result<void> CheckHostHeader(std::string_view host)
{
    if (!IsFieldValue(host))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            "host",
            "a host without control characters",
            Core::QuoteForError(host));
    }
    return {};
}

} // namespace ACS::ProtocolBeast

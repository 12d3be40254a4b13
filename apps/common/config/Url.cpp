#include "common/config/Url.hpp"

#include <acs/core/ShownURL.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ACS::Apps
{

namespace
{

struct SchemeRule
{
    EUrlScheme scheme;
    std::string_view name;
    std::uint16_t port;
    bool bHasPath;
    bool bSecure;
};

constexpr std::array<SchemeRule, 7> RULES{{
    {EUrlScheme::Ws, "ws", 80, true, false},
    {EUrlScheme::Wss, "wss", 443, true, true},
    {EUrlScheme::Mqtt, "mqtt", 1883, false, false},
    {EUrlScheme::Mqtts, "mqtts", 8883, false, true},
    {EUrlScheme::Tcp, "tcp", 49000, false, false},
    {EUrlScheme::Http, "http", 80, true, false},
    {EUrlScheme::Https, "https", 443, true, true},
}};

const SchemeRule& GetRule(EUrlScheme scheme)
{
    return RULES.at(static_cast<std::size_t>(scheme));
}

std::string MakeAllowedText(const std::vector<EUrlScheme>& allowed)
{
    std::string text = "a URL ";
    for (const EUrlScheme scheme : allowed)
    {
        const SchemeRule& rule = GetRule(scheme);
        text += text.back() == ' ' ? "" : " or ";
        text += fmt::format("{}://HOST[:PORT]{}", rule.name, rule.bHasPath ? "[/PATH]" : "");
    }
    return text;
}

/// Whether the text is printable, without blanks and without a fragment.
bool IsPath(std::string_view text)
{
    return std::all_of(text.begin(), text.end(), [](char character) {
        return character > ' ' && character < '\x7f' && character != '#';
    });
}

} // namespace

Core::Result<Url> ParseURL(std::string_view text, const std::vector<EUrlScheme>& allowed)
{
    const auto fail = [text, &allowed] {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            {},
            MakeAllowedText(allowed),
            fmt::format("'{}'", Core::MakeShownURL(text)));
    };
    const std::size_t colon = text.find("://");
    if (colon == std::string_view::npos)
    {
        return fail();
    }
    const std::string_view name = text.substr(0, colon);
    const auto scheme = std::find_if(allowed.begin(), allowed.end(), [name](EUrlScheme candidate) {
        return GetRule(candidate).name == name;
    });
    if (scheme == allowed.end())
    {
        return fail();
    }
    const SchemeRule& rule = GetRule(*scheme);
    const std::string_view rest = text.substr(colon + 3);
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view authority = rest.substr(0, slash);
    const std::string_view path = rest.substr(slash);
    const bool bPathAllowed = rule.bHasPath || path.empty() || path == "/";
    if (!bPathAllowed || !IsPath(path))
    {
        return fail();
    }
    const std::size_t lastColon = authority.rfind(':');
    const bool bHasPort = lastColon != std::string_view::npos && !authority.empty() && authority.back() != ']';
    Core::Result<Endpoint> peer =
        ParseEndpoint(bHasPort ? std::string(authority) : fmt::format("{}:{}", authority, rule.port));
    if (!peer.has_value() || peer->port == 0)
    {
        return fail();
    }
    std::string wholePath;
    if (rule.bHasPath)
    {
        wholePath = path.empty() ? "/" : std::string(path);
    }
    return Url{*scheme, std::move(*peer), std::move(wholePath)};
}

std::string MakeText(const Url& url)
{
    return fmt::format("{}://{}{}", GetRule(url.scheme).name, MakeText(url.peer), url.path);
}

bool IsSecure(EUrlScheme scheme)
{
    return GetRule(scheme).bSecure;
}

} // namespace ACS::Apps

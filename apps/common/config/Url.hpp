#pragma once

#include "common/config/Endpoint.hpp"
#include <acs/core/Result.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

enum class EUrlScheme : std::uint8_t
{
    Ws,    ///< Default port 80.
    Wss,   ///< 443
    Mqtt,  ///< 1883
    Mqtts, ///< 8883
    Tcp,   ///< 49000
    Http,  ///< 80
    Https, ///< 443
};

/// The URL of a peer.
struct Url
{
    EUrlScheme scheme = EUrlScheme::Tcp;
    Endpoint peer; ///< The port is never 0.
    std::string
        path; ///< With its query. Default "/" for ws, wss, http and https; always empty for mqtt, mqtts and tcp.

    bool operator==(const Url&) const = default;
};

/// SCHEME://HOST[:PORT][/PATH]; other schemes, user names and fragments are refused.
[[nodiscard]] Core::Result<Url> ParseURL(std::string_view text, const std::vector<EUrlScheme>& allowed);

/// The URL as text, always with the port.
[[nodiscard]] std::string MakeText(const Url& url);

/// wss, mqtts and https: the connection is encrypted.
[[nodiscard]] bool IsSecure(EUrlScheme scheme);

} // namespace ACS::Apps

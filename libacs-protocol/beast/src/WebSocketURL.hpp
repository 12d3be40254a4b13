#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// ws://host[:port][/path] or wss://…
struct WebSocketURL
{
    bool bSecure = false;
    std::string host; ///< Without the brackets of an IPv6 address.
    std::string port;
    std::string hostHeader; ///< Host and, where it is given, port, as the URL has them.
    std::string target;     ///< Path and query, at least a slash.
};

[[nodiscard]] Core::Result<WebSocketURL> ParseWebSocketURL(std::string_view text);

} // namespace ACS::ProtocolBeast

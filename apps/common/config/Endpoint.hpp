#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// A host and a port.
struct Endpoint
{
    std::string host;       ///< A name or an address; an IPv6 address without its brackets.
    std::uint16_t port = 0; ///< 0: any free port.

    bool operator==(const Endpoint&) const = default;
};

/// "HOST:PORT"; an IPv6 address is in brackets ("[::1]:80"). Port 0 is allowed.
[[nodiscard]] Core::Result<Endpoint> ParseEndpoint(std::string_view text);

/// Whether the host is this machine for sure: localhost, or an address of the loopback interface.
[[nodiscard]] bool IsLoopback(const std::string& host);

/// The endpoint as ParseEndpoint reads it.
[[nodiscard]] std::string MakeText(const Endpoint& endpoint);

} // namespace ACS::Apps

#pragma once

#include <acs/core/Backoff.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace ACS::Acsd
{

/// Address, limits and times of a LineClient.
struct LineClientOptions
{
    std::string host;       ///< A name or an address.
    std::uint16_t port = 0; ///< Of the peer; 1 to 65535.
    std::size_t maximumLineBytes =
        std::size_t{64} * 1024;                      ///< Without the end of the line, in both directions; at least 1.
    std::size_t maximumQueuedLines = 256;            ///< Lines that the peer has not accepted; at least 1.
    std::chrono::milliseconds connectTimeout{5'000}; ///< Including the resolution of the name.
    /// Maximum time between two lines of the peer; 0: no limit. A peer that was switched off is not noticed without it.
    std::chrono::milliseconds receiveTimeout{0};
    Core::BackoffOptions backoff; ///< Starts again when a line has been received.
    /// RobotServices::mayCommand, asked before each line: false ends the connection instead. May be empty: lines may always be sent.
    std::function<bool()> maySend{};
};

} // namespace ACS::Acsd

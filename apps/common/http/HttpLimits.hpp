#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace ACS::Apps
{

/// Limits for one peer and for all of them.
struct HttpLimits
{
    std::uint32_t maxHeaderBytes = 16U * 1024U;
    std::uint64_t maxBodyBytes = 1024U * 1024U;
    /// For a whole request, for an idle connection, and for a peer to read a response or the next piece of a stream.
    std::chrono::milliseconds timeout{30'000};
    /// A further connection replaces the one that has waited longest for a complete request, else the one that has not read
    /// its response for the longest time. While the handler's responses to all of them are delayed, it waits.
    std::size_t maxConnections = 64;
    /// Of these, from one address (of IPv6, from one /64): a further one replaces a connection of the same peer.
    std::size_t maxPerPeer = 32;
    /// Connections with an HttpBodyStream, which are never replaced: the others are left for requests.
    std::size_t maxStreams = 32;
    std::size_t maxStreamsPerPeer = 16;
};

} // namespace ACS::Apps

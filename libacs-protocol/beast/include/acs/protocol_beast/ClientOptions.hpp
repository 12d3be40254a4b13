#pragma once

#include <acs/protocol/SessionOptions.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace ACS::ProtocolBeast
{

/// How a WebSocket connection behaves; the same on both sides.
struct LinkOptions
{
    std::chrono::milliseconds handshakeTimeout{10'000}; ///< From the first packet to the end of the upgrade.
    std::chrono::milliseconds closeTimeout{2'000};      ///< For the closing handshake; then the socket is closed.
    std::chrono::milliseconds pingInterval{10'000};     ///< `mcs.ping_interval`: silence after which a ping is sent.
    std::size_t pingMisses = 2;                         ///< Unanswered intervals after which the link is dead.
    std::size_t maximumRead = 4U * 1024U * 1024U;       ///< `mcs.max_rx_bytes`: longest message.
    std::size_t maximumQueued = 16U * 1024U * 1024U; ///< Bytes that wait to be written; beyond it the link is dropped.
};

/// Where and how an AcsClient connects.
struct ClientOptions
{
    std::string url;  ///< `mcs.url`: ws://host[:port][/path]; wss is refused with a sentence.
    std::string host; ///< Host header, where it must differ from the URL's.
    std::vector<std::pair<std::string, std::string>> headers; ///< `mcs.headers`, for example Authorization.
    LinkOptions link{};
    Protocol::SessionOptions session{};
};

} // namespace ACS::ProtocolBeast

#pragma once

#include <acs/protocol/SessionOptions.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>
#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// How a WebSocket connection behaves; the same on both sides.
struct LinkOptions
{
    std::chrono::milliseconds handshakeTimeout{10'000}; ///< For TCP, for TLS, for the upgrade; a server: for all three.
    std::chrono::milliseconds closeTimeout{2'000};      ///< For the closing handshake; then the socket is closed.
    /// `mcs.ping_interval`. A link is dead after `pingMisses` intervals of silence; a ping goes out after half of that.
    std::chrono::milliseconds pingInterval{10'000};
    std::size_t pingMisses = 2;                      ///< At least 1.
    std::size_t maximumRead = 4U * 1024U * 1024U;    ///< `mcs.max_rx_bytes`: longest message.
    std::size_t maximumQueued = 16U * 1024U * 1024U; ///< Bytes that wait to be written; beyond it the link is dropped.
    bool bLastFrameOnly =
        false; ///< A habit of the public MCS (section 12): of a fragmented message its end is read only.
};

/// Where and how an AcsClient connects.
struct ClientOptions
{
    std::string url;     ///< `mcs.url`: ws://host[:port][/path] or wss://…
    std::string host;    ///< Host header, where it must differ from the URL's.
    HttpHeaders headers; ///< `mcs.headers`, for example Authorization.
    TlsOptions tls{};    ///< For wss; refused with ws where anything is in it.
    LinkOptions link{};
    Protocol::SessionOptions session{};
    /// Sees every text: what comes before the session judges it, what goes as it is handed to the connection. May be empty.
    /// The view is valid during the call, which is made on the executor and must not call the client.
    std::function<void(EWireDirection direction, std::string_view text)> onWire;
};

} // namespace ACS::ProtocolBeast

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

/// Times and limits of a WebSocket connection, on both sides.
struct LinkOptions
{
    /// Maximum time of the TCP connect, of the TLS handshake and of the upgrade each; for a server, of all three together.
    std::chrono::milliseconds handshakeTimeout{10'000};
    std::chrono::milliseconds closeTimeout{2'000}; ///< Of the closing handshake; then the socket is closed.
    /// A connection is dead after pingMisses intervals without data; a ping is sent after half of that.
    std::chrono::milliseconds pingInterval{10'000};
    std::size_t pingMisses = 2;                      ///< At least 1.
    std::size_t maximumRead = 4U * 1024U * 1024U;    ///< Bytes of the longest message.
    std::size_t maximumQueued = 16U * 1024U * 1024U; ///< Unsent bytes above which the connection is closed.
    bool bLastFrameOnly = false;                     ///< Read only the last frame of a fragmented message.
};

/// Where and how an AcsClient connects.
struct ClientOptions
{
    std::string url;                    ///< ws://host[:port][/path] or wss://…
    std::string host;                   ///< Host header, if it must differ from the URL's host.
    HttpHeaders headers;                ///< Additional headers, for example Authorization.
    TlsOptions tls{};                   ///< For wss; must be empty for ws.
    LinkOptions link{};                 ///< Times and limits of the connection.
    Protocol::SessionOptions session{}; ///< Of the AcsSession.
    /// Called with every text: received ones before the session handles them, sent ones when they are passed to the
    /// connection. May be empty. The view is valid during the call, which is made on the executor and must not call the
    /// client.
    std::function<void(EWireDirection direction, std::string_view text)> onWire;
};

} // namespace ACS::ProtocolBeast

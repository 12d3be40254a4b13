#pragma once

#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// Sees every text: what comes before the session judges it, what goes as it is handed to the connection. The view is
/// valid during the call, which is made on the executor and must not call the server.
using WireObserver =
    std::function<void(EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)>;

/// Where an McsServer listens.
struct ServerOptions
{
    std::string address = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 0;            ///< 0: one that is free; GetPort tells.
    std::string path = "/acs/";        ///< With or without the last slash; every other path gets 404.
    std::size_t maximumClients = 16;   ///< Connections at a time, those without an upgrade included.
    std::optional<TlsOptions> tls{};   ///< There: wss and nothing else, with certificate and key.
    LinkOptions link{};
    Protocol::McsSessionOptions session{};
    WireObserver onWire; ///< May be empty.
};

} // namespace ACS::ProtocolBeast

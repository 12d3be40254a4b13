#pragma once

#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

/// Called with every text: received ones before the session handles them, sent ones when they are passed to the
/// connection. The view is valid during the call, which is made on the executor and must not call the server.
using WireObserver =
    std::function<void(EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)>;

/// Called with every request for a WebSocket at the server's path, before the session has its connection; nullopt
/// accepts it. The call is made on the executor; it must not block, throw or call the server.
using UpgradeCheck = std::function<std::optional<UpgradeRefusal>(const UpgradeRequest& request)>;

/// Where an McsServer listens.
struct ServerOptions
{
    std::string address = "127.0.0.1"; ///< An address, or a name that resolves to one.
    std::uint16_t port = 0;            ///< 0: a free port, see GetPort.
    /// With or without the trailing slash; other paths are answered with 404. Empty: every path, for a checkUpgrade.
    std::string path = "/acs/";
    std::size_t maximumClients = 16;       ///< Maximum number of connections, including those before the upgrade.
    std::optional<TlsOptions> tls{};       ///< If set: wss only, with certificate and key.
    LinkOptions link{};                    ///< Times and limits of each connection.
    Protocol::McsSessionOptions session{}; ///< Of the McsSession that the server creates.
    UpgradeCheck checkUpgrade;             ///< May be empty: every client is accepted.
    WireObserver onWire;                   ///< May be empty.
};

} // namespace ACS::ProtocolBeast

#pragma once

#include "IGate.hpp"
#include "IPortUser.hpp"
#include "ITransport.hpp"
#include <acs/net/TcpListener.hpp>
#include <acs/protocol_beast/McsPort.hpp>

#include <boost/asio/ip/tcp.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::ProtocolBeast
{

/// Accepts connections and passes those that become a WebSocket to the server that they ask for.
class McsPort::Impl : public std::enable_shared_from_this<McsPort::Impl>
{
    using Tcp = boost::asio::ip::tcp;

    boost::asio::any_io_executor _executor;
    Core::Logger _logger;
    PortOptions _options;
    std::unique_ptr<ITransport> _transport;
    std::shared_ptr<Net::TcpListener> _listener;
    std::map<Protocol::ConnectionID, std::shared_ptr<IGate>> _gates;
    std::vector<std::weak_ptr<IPortUser>> _users;
    Protocol::ConnectionID _lastID = 0;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::Logger& logger,
        const PortOptions& options,
        std::unique_ptr<ITransport> transport);
    [[nodiscard]] Core::Result<void> Listen();

    /// Accepts no new connections, and closes those before the upgrade.
    void Stop();

    void Add(const std::shared_ptr<IPortUser>& user);
    void Remove(const IPortUser& user);
    [[nodiscard]] std::uint16_t GetPort() const noexcept;
    [[nodiscard]] const boost::asio::any_io_executor& GetExecutor() const noexcept;

private:
    void OnAccepted(Tcp::socket socket);
    [[nodiscard]] GateOwner MakeGateOwner(
        Protocol::ConnectionID connection,
        const std::optional<Tcp::endpoint>& peerOrNull);
    [[nodiscard]] GateDecision Decide(const UpgradeRequest& request, bool bWebSocket);
    /// For a client at another path. A server that shares the port with others is not named.
    [[nodiscard]] std::string DescribePath() const;
    [[nodiscard]] std::size_t CountLinks() const;
};

} // namespace ACS::ProtocolBeast

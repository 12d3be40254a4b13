#include "ActionPump.hpp"
#include "EventQueue.hpp"
#include "PlainTransport.hpp"
#include "TlsTransport.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/TcpListener.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

using Tcp = boost::asio::ip::tcp;
using SessionTimers = Net::TimerArray<Protocol::ESessionTimer, Protocol::TIMER_COUNT>;

constexpr unsigned HTTP_FORBIDDEN = 403;
constexpr unsigned HTTP_NOT_FOUND = 404;
constexpr unsigned HTTP_UPGRADE_REQUIRED = 426;
constexpr unsigned HTTP_UNAVAILABLE = 503;

std::string_view StripTarget(std::string_view target)
{
    target = target.substr(0, target.find_first_of("?#"));
    while (!target.empty() && target.back() == '/')
    {
        target.remove_suffix(1);
    }
    return target;
}

/// An IPv4 address in its own form, also on a socket for both kinds.
std::string GetText(const boost::asio::ip::address& address)
{
    namespace ip = boost::asio::ip;
    return address.is_v6() && address.to_v6().is_v4_mapped()
        ? ip::make_address_v4(ip::v4_mapped, address.to_v6()).to_string()
        : address.to_string();
}

} // namespace

class McsServer::Impl : public std::enable_shared_from_this<McsServer::Impl>
{
    const Core::IClock& _clock;
    Core::Logger _logger;
    ServerOptions _options;
    std::unique_ptr<Protocol::IMcsSession> _session;
    std::shared_ptr<EventQueue> _events;
    std::shared_ptr<SessionTimers> _timers;
    std::unique_ptr<ITransport> _transport;
    std::shared_ptr<Net::TcpListener> _listener;
    std::map<Protocol::ConnectionID, std::shared_ptr<IGate>> _gates;
    std::map<Protocol::ConnectionID, std::shared_ptr<ILink>> _links;
    Protocol::ConnectionID _lastID = 0;
    ActionPump _pump;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        const Core::Logger& logger,
        const ServerOptions& options,
        std::unique_ptr<ITransport> transport,
        std::unique_ptr<Protocol::IMcsSession> ownedSession,
        ISessionHandler& handler)
        : _clock(clock),
          _logger(logger),
          _options(options),
          _session(std::move(ownedSession)),
          _events(std::make_shared<EventQueue>(executor, handler)),
          _timers(std::make_shared<SessionTimers>(
              executor,
              [this](Protocol::ESessionTimer timer) {
                  Run([timer](auto& session, Core::Now now, auto& out) { session.OnTimer(timer, now, out); });
              })),
          _transport(std::move(transport)),
          _listener(std::make_shared<Net::TcpListener>(executor, logger, [this](Tcp::socket socket) {
              OnAccepted(std::move(socket));
              return true;
          }))
    {
    }

    Core::Result<void> Listen()
    {
        const Core::Result<std::uint16_t> port = _listener->Listen(_options.address, _options.port);
        if (!port.has_value())
        {
            return tl::make_unexpected(port.error());
        }
        _options.port = *port;
        return {};
    }

    void Detach()
    {
        _events->Detach();
        _timers->CancelAll();
        _listener->Stop();
        for (const auto& [connection, gate] : std::exchange(_gates, {}))
        {
            gate->Kill();
        }
        for (const auto& [connection, link] : std::exchange(_links, {}))
        {
            link->Kill();
        }
    }

    void Stop()
    {
        _listener->Stop();
        for (const auto& [connection, gate] : std::exchange(_gates, {}))
        {
            gate->Kill();
        }
        for (const auto& [connection, link] : _links)
        {
            link->Close(Protocol::CLOSE_NORMAL, "shutting down");
        }
    }

    template <typename TCall>
    void Run(TCall call)
    {
        _pump.Run(
            [this, &call](Protocol::SessionActions& out) { call(*_session, _clock.GetNow(), out); },
            [this](const Protocol::SessionAction& action) { Act(action); });
    }

    [[nodiscard]] std::uint16_t GetPort() const
    {
        return _options.port;
    }

    [[nodiscard]] const Protocol::IMcsSession& GetSession() const
    {
        return *_session;
    }

private:
    void OnAccepted(Tcp::socket socket)
    {
        if (_gates.size() + _links.size() >= _options.maximumClients)
        {
            _logger.Warning("refused a connection: too many clients", {});
            return;
        }
        const Protocol::ConnectionID connection = ++_lastID;
        boost::system::error_code unknown;
        const Tcp::endpoint peer = socket.remote_endpoint(unknown);
        GateOwner gateOwner = MakeGateOwner(connection, unknown ? std::nullopt : std::optional(peer));
        const std::shared_ptr<IGate> gate =
            _transport->MakeGate(std::move(socket), _options.link, std::move(gateOwner), MakeOwner(connection));
        _gates.emplace(connection, gate);
        gate->RunAsync();
    }

    GateOwner MakeGateOwner(Protocol::ConnectionID connection, const std::optional<Tcp::endpoint>& peerOrNull)
    {
        const std::weak_ptr<Impl> weak = weak_from_this();
        GateOwner owner;
        owner.judge =
            [weak, connection, peerOrNull](UpgradeRequest request, bool bWebSocket) -> std::optional<UpgradeRefusal> {
            const auto self = weak.lock();
            if (self == nullptr)
            {
                return UpgradeRefusal{HTTP_UNAVAILABLE, {}, {}};
            }
            request.connection = connection;
            if (peerOrNull.has_value())
            {
                request.peerAddress = GetText(peerOrNull->address());
                request.peerPort = peerOrNull->port();
            }
            return self->JudgeOrNull(request, bWebSocket);
        };
        owner.onAccepted = [weak, connection](std::shared_ptr<ILink> link) {
            if (const auto self = weak.lock())
            {
                self->_gates.erase(connection);
                self->_links.emplace(connection, std::move(link));
            }
        };
        owner.onRefused = [weak](const std::string& reason) {
            if (const auto self = weak.lock())
            {
                self->_logger.Warning("a connection did not become a WebSocket", {{"reason", reason}});
            }
        };
        owner.onEnded = [weak, connection] {
            if (const auto self = weak.lock())
            {
                self->_gates.erase(connection);
            }
        };
        return owner;
    }

    [[nodiscard]] std::optional<UpgradeRefusal> JudgeOrNull(const UpgradeRequest& request, bool bWebSocket) const
    {
        if (!_options.path.empty() && StripTarget(request.target) != StripTarget(_options.path))
        {
            return UpgradeRefusal{HTTP_NOT_FOUND, "The ACS connects at " + _options.path + ".\n", {}};
        }
        if (!bWebSocket)
        {
            return UpgradeRefusal{
                HTTP_UPGRADE_REQUIRED,
                "This is the MCS end of MCS-ACS: connect with a WebSocket.\n",
                {}};
        }
        if (_options.checkUpgrade)
        {
            std::optional<UpgradeRefusal> refusal = _options.checkUpgrade(request);
            if (refusal.has_value())
            {
                return refusal;
            }
        }
        if (_session->ShouldRefuseUpgrade())
        {
            return UpgradeRefusal{HTTP_FORBIDDEN, "An ACS is connected already.\n", {}};
        }
        return std::nullopt;
    }

    LinkOwner MakeOwner(Protocol::ConnectionID connection)
    {
        const std::weak_ptr<Impl> weak = weak_from_this();
        LinkOwner owner;
        owner.onOpen = [weak, connection] {
            if (const auto self = weak.lock())
            {
                self->Run([connection](auto& session, Core::Now now, auto& out) {
                    session.OnConnected(connection, now, out);
                });
            }
        };
        owner.onText = [weak, connection](std::string_view text) {
            if (const auto self = weak.lock())
            {
                self->Observe(EWireDirection::In, connection, text);
                self->Run([connection, text](auto& session, Core::Now now, auto& out) {
                    session.OnText(connection, text, now, out);
                });
            }
        };
        owner.onClosed = [weak, connection](const std::string& reason) {
            if (const auto self = weak.lock())
            {
                self->_logger.Debug("client gone", {{"reason", reason}});
                self->_links.erase(connection);
                self->Run([connection, &reason](auto& session, Core::Now now, auto& out) {
                    session.OnClosed(connection, reason, now, out);
                });
            }
        };
        return owner;
    }

    void Observe(EWireDirection direction, Protocol::ConnectionID connection, std::string_view text) const
    {
        if (_options.onWire)
        {
            _options.onWire(direction, connection, text);
        }
    }

    void Act(const Protocol::SessionAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const Protocol::SendText& send) {
                    const auto found = _links.find(send.connection);
                    if (found != _links.end())
                    {
                        Observe(EWireDirection::Out, send.connection, send.text);
                        found->second->Send(send.text, send.bDroppable);
                    }
                },
                [](const Protocol::Connect& /*connect*/) {},
                [this](const Protocol::Close& close) {
                    const auto found = _links.find(close.connection);
                    if (found == _links.end())
                    {
                        return;
                    }
                    if (close.code == Protocol::CLOSE_ABNORMAL)
                    {
                        found->second->Abort(close.reason);
                        return;
                    }
                    found->second->Close(close.code, close.reason);
                },
                [this](const Protocol::StartTimer& start) { _timers->Start(start.timer, start.delay); },
                [this](const Protocol::CancelTimer& cancel) { _timers->Cancel(cancel.timer); },
                [this](const Protocol::Deliver& deliver) { _events->Push(deliver.event); },
            },
            action);
    }
};

McsServer::McsServer(std::shared_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

McsServer::~McsServer()
{
    _impl->Detach();
}

Core::Result<std::unique_ptr<McsServer>> McsServer::Create(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    const ServerOptions& options,
    ISessionHandler& handler)
{
    return Create(
        executor,
        clock,
        logger,
        options,
        std::make_unique<Protocol::McsSession>(options.session, random),
        handler);
}

Core::Result<std::unique_ptr<McsServer>> McsServer::Create(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    const Core::Logger& logger,
    const ServerOptions& options,
    std::unique_ptr<Protocol::IMcsSession> session,
    ISessionHandler& handler)
{
    Core::Result<std::unique_ptr<ITransport>> transport =
        options.tls.has_value() ? MakeTlsServerTransport(*options.tls) : MakePlainTransport();
    if (!transport.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(transport.error()));
    }
    auto impl =
        std::make_shared<Impl>(executor, clock, logger, options, std::move(*transport), std::move(session), handler);
    Core::Result<void> listened = impl->Listen();
    if (!listened.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(listened.error()));
    }
    return std::unique_ptr<McsServer>(new McsServer(std::move(impl))); // the constructor is private
}

std::uint16_t McsServer::GetPort() const
{
    return _impl->GetPort();
}

void McsServer::Stop()
{
    _impl->Stop();
}

bool McsServer::TryAnswer(Protocol::AnswerToken token, Protocol::EAckResult result, std::string_view message)
{
    bool bTaken = false;
    _impl->Run(
        [&](auto& session, Core::Now now, auto& out) { bTaken = session.TryAnswer(token, result, message, now, out); });
    return bTaken;
}

Protocol::AcsRequest McsServer::MakeRequest(Protocol::AcsPayload payload)
{
    Protocol::AcsRequest request;
    _impl->Run(
        [&](auto& session, Core::Now now, auto& /*out*/) { request = session.MakeRequest(std::move(payload), now); });
    return request;
}

bool McsServer::TrySend(const Protocol::AcsRequest& request)
{
    bool bTaken = false;
    _impl->Run(
        [&request, &bTaken](auto& session, Core::Now now, auto& out) { bTaken = session.TrySend(request, now, out); });
    return bTaken;
}

void McsServer::Run(const SessionCall& call)
{
    _impl->Run([&call](auto& /*session*/, Core::Now now, auto& out) { call(now, out); });
}

bool McsServer::IsTakingPlans() const
{
    return _impl->GetSession().IsTakingPlans();
}

bool McsServer::IsRegistered() const
{
    return _impl->GetSession().GetRegisteredOrNull().has_value();
}

std::size_t McsServer::GetPendingCount() const
{
    return _impl->GetSession().GetPendingCount();
}

std::size_t McsServer::GetUnansweredCount() const
{
    return _impl->GetSession().GetUnansweredCount();
}

const Protocol::SessionStatistics& McsServer::GetStatistics() const
{
    return _impl->GetSession().GetStatistics();
}

} // namespace ACS::ProtocolBeast

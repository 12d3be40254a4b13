#include "IPortUser.hpp"
#include "McsPort.Impl.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/net/ActionPump.hpp>
#include <acs/net/EventQueue.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

using SessionEvents = Net::EventQueue<Protocol::SessionEvent>;
using SessionTimers = Net::TimerArray<Protocol::ESessionTimer, Protocol::TIMER_COUNT>;

constexpr unsigned HTTP_FORBIDDEN = 403;

} // namespace

class McsServer::Impl final : public IPortUser, public std::enable_shared_from_this<McsServer::Impl>
{
    const Core::IClock& _clock;
    Core::Logger _logger;
    ServerOptions _options;
    std::unique_ptr<Protocol::IMcsSession> _session;
    std::shared_ptr<SessionEvents> _events;
    std::shared_ptr<SessionTimers> _timers;
    std::unique_ptr<McsPort> _ownPortOrNull; ///< Unless it shares one.
    std::shared_ptr<McsPort::Impl> _port;
    std::map<Protocol::ConnectionID, std::shared_ptr<ILink>> _links;
    Net::ActionPump<Protocol::SessionAction> _pump;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        const Core::Logger& logger,
        const ServerOptions& options,
        std::unique_ptr<Protocol::IMcsSession> ownedSession,
        ISessionHandler& handler)
        : _clock(clock),
          _logger(logger),
          _options(options),
          _session(std::move(ownedSession)),
          _events(std::make_shared<SessionEvents>(
              executor,
              [&handler](const Protocol::SessionEvent& event) { handler.OnSessionEvent(event); })),
          _timers(std::make_shared<SessionTimers>(executor, [this](Protocol::ESessionTimer timer) {
              Run([timer](auto& session, Core::Now now, auto& out) { session.OnTimer(timer, now, out); });
          }))
    {
    }

    void Join(const std::shared_ptr<McsPort::Impl>& port, std::unique_ptr<McsPort> ownPortOrNull)
    {
        _port = port;
        _ownPortOrNull = std::move(ownPortOrNull);
        _port->Add(shared_from_this());
    }

    void Detach()
    {
        _events->Detach();
        _timers->CancelAll();
        LeavePort();
        for (const auto& [connection, link] : std::exchange(_links, {}))
        {
            link->Kill();
        }
    }

    void Stop()
    {
        LeavePort();
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
        return _port->GetPort();
    }

    [[nodiscard]] const Protocol::IMcsSession& GetSession() const
    {
        return *_session;
    }

    [[nodiscard]] const std::string& GetPath() const override
    {
        return _options.path;
    }

    [[nodiscard]] std::optional<UpgradeRefusal> JudgeOrNull(const UpgradeRequest& request) const override
    {
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

    void OnAccepted(Protocol::ConnectionID connection, std::shared_ptr<ILink> link) override
    {
        _links.emplace(connection, std::move(link));
    }

    [[nodiscard]] std::size_t CountLinks() const override
    {
        return _links.size();
    }

    [[nodiscard]] LinkOwner MakeLinkOwner(Protocol::ConnectionID connection) override
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

private:
    void LeavePort()
    {
        _port->Remove(*this);
        _ownPortOrNull.reset(); // which closes the connections before the upgrade
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
    const PortOptions portOptions{options.address, options.port, options.maximumClients, options.tls, options.link};
    Core::Result<std::unique_ptr<McsPort>> port = McsPort::Create(executor, logger, portOptions);
    if (!port.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(port.error()));
    }
    auto impl = std::make_shared<Impl>(executor, clock, logger, options, std::move(session), handler);
    const std::shared_ptr<McsPort::Impl> shared = (*port)->_impl;
    impl->Join(shared, std::move(*port));
    return std::unique_ptr<McsServer>(new McsServer(std::move(impl))); // the constructor is private
}

std::unique_ptr<McsServer> McsServer::Create(
    McsPort& port,
    const Core::IClock& clock,
    const Core::Logger& logger,
    const ServerOptions& options,
    std::unique_ptr<Protocol::IMcsSession> session,
    ISessionHandler& handler)
{
    auto impl = std::make_shared<Impl>(port._impl->GetExecutor(), clock, logger, options, std::move(session), handler);
    impl->Join(port._impl, nullptr);
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

void McsServer::Close(Protocol::ConnectionID connection, std::string_view reason)
{
    Run([connection, reason](Core::Now /*now*/, Protocol::SessionActions& out) {
        out.emplace_back(Protocol::Close{connection, Protocol::CLOSE_POLICY, std::string(reason)});
    });
}

bool McsServer::IsTakingPlans() const
{
    return _impl->GetSession().IsTakingPlans();
}

bool McsServer::IsRegistered() const
{
    return GetRegisteredOrNull().has_value();
}

std::optional<Protocol::ConnectionID> McsServer::GetRegisteredOrNull() const
{
    return _impl->GetSession().GetRegisteredOrNull();
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

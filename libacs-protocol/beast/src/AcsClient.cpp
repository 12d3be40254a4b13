#include "PlainTransport.hpp"
#include "TlsTransport.hpp"
#include "WebSocketURL.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/ShownURL.hpp>
#include <acs/net/ActionPump.hpp>
#include <acs/net/AddressRotation.hpp>
#include <acs/net/EventQueue.hpp>
#include <acs/net/HostLookup.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol_beast/AcsClient.hpp>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <utility>

namespace ACS::ProtocolBeast
{

using Tcp = boost::asio::ip::tcp;
using ErrorCode = boost::beast::error_code;

using SessionEvents = Net::EventQueue<Protocol::SessionEvent>;
using SessionTimers = Net::TimerArray<Protocol::ESessionTimer, Protocol::TIMER_COUNT>;

namespace
{

Core::Result<std::unique_ptr<ITransport>> MakeTransport(const ClientOptions& options, const WebSocketURL& url)
{
    if (url.bSecure)
    {
        return MakeTlsClientTransport(options.tls, url.host);
    }
    if (options.tls != TlsOptions())
    {
        // TLS options with a ws URL: the connection would not be encrypted.
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            "url",
            "wss://…, because options for TLS are given",
            Core::QuoteForError(Core::MakeShownURL(options.url)));
    }
    return MakePlainTransport();
}

} // namespace

class AcsClient::Impl : public std::enable_shared_from_this<AcsClient::Impl>
{
    boost::asio::any_io_executor _executor;
    const Core::IClock& _clock;
    Core::Logger _logger;
    ClientOptions _options;
    WebSocketURL _url;
    Protocol::AcsSession _session;
    std::shared_ptr<SessionEvents> _events;
    std::shared_ptr<SessionTimers> _timers;
    Net::HostLookup _lookup;
    Net::AddressRotation _addresses;
    boost::asio::steady_timer _lookupTimer;
    std::unique_ptr<ITransport> _transport;
    std::shared_ptr<ILink> _linkOrNull;
    Net::ActionPump<Protocol::SessionAction> _pump;

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        const ClientOptions& options,
        WebSocketURL url,
        std::unique_ptr<ITransport> transport,
        ISessionHandler& handler)
        : _executor(executor),
          _clock(clock),
          _logger(logger),
          _options(options),
          _url(std::move(url)),
          _session(options.session, random),
          _events(std::make_shared<SessionEvents>(
              executor,
              [&handler](const Protocol::SessionEvent& event) { handler.OnSessionEvent(event); })),
          _timers(std::make_shared<SessionTimers>(
              executor,
              [this](Protocol::ESessionTimer timer) {
                  Run([timer](auto& session, Core::Now now, auto& out) { session.OnTimer(timer, now, out); });
              })),
          _lookup(executor),
          _lookupTimer(executor),
          _transport(std::move(transport))
    {
    }

    void Detach()
    {
        _events->Detach();
        _timers->CancelAll();
        CancelLookup();
        if (_linkOrNull != nullptr)
        {
            std::exchange(_linkOrNull, nullptr)->Kill();
        }
    }

    template <typename TCall>
    void Run(TCall call)
    {
        _pump.Run(
            [this, &call](Protocol::SessionActions& out) { call(_session, _clock.GetNow(), out); },
            [this](const Protocol::SessionAction& action) { Act(action); });
    }

    [[nodiscard]] const Protocol::AcsSession& GetSession() const
    {
        return _session;
    }

    void SetSiteOffset(std::chrono::minutes offset)
    {
        _session.SetSiteOffset(offset);
    }

    Core::Result<void> ReloadTLS()
    {
        Core::Result<std::unique_ptr<ITransport>> transport = MakeTransport(_options, _url);
        if (!transport.has_value())
        {
            return tl::unexpected<Core::Error>(std::move(transport.error()));
        }
        _transport = std::move(*transport);
        return {};
    }

private:
    void Act(const Protocol::SessionAction& action)
    {
        std::visit(
            Core::Overloaded{
                [this](const Protocol::SendText& send) {
                    if (_linkOrNull != nullptr)
                    {
                        Observe(EWireDirection::Out, send.text);
                        _linkOrNull->Send(send.text, send.bDroppable);
                    }
                },
                [this](const Protocol::Connect& /*connect*/) { ConnectAsync(); },
                [this](const Protocol::Close& close) {
                    CancelLookup();
                    if (_linkOrNull != nullptr)
                    {
                        _linkOrNull->Close(close.code, close.reason);
                    }
                },
                [this](const Protocol::StartTimer& start) { _timers->Start(start.timer, start.delay); },
                [this](const Protocol::CancelTimer& cancel) { _timers->Cancel(cancel.timer); },
                [this](const Protocol::Deliver& deliver) { _events->Push(deliver.event); },
            },
            action);
    }

    void Observe(EWireDirection direction, std::string_view text) const
    {
        if (_options.onWire)
        {
            _options.onWire(direction, text);
        }
    }

    void ConnectAsync()
    {
        _logger.Debug("connecting", {{"url", Core::MakeShownURL(_options.url)}});
        const std::shared_ptr<ILink> link = _transport->MakeClientLink(_executor, _options.link, MakeOwner());
        _linkOrNull = link;
        _lookupTimer.expires_after(_options.link.handshakeTimeout);
        _lookupTimer.async_wait([weak = weak_from_this(), link](ErrorCode error) {
            const auto self = weak.lock();
            if (!error && self != nullptr && self->_linkOrNull == link)
            {
                self->_lookup.Cancel();
                link->Abort("cannot find " + self->_url.host + ": the name server does not answer");
            }
        });
        _lookup.ResolveAsync(
            _url.host,
            _url.port,
            [weak = weak_from_this(), link](ErrorCode error, const Net::HostLookup::Addresses& results) {
                const auto self = weak.lock();
                if (self == nullptr || self->_linkOrNull != link)
                {
                    return;
                }
                self->StopLookupTimer();
                if (error)
                {
                    link->Abort("cannot find " + self->_url.host + ": " + error.message());
                    return;
                }
                self->ConnectToAsync(link, results);
            });
    }

    void CancelLookup()
    {
        StopLookupTimer();
        _lookup.Cancel();
    }

    void StopLookupTimer()
    {
        ErrorCode ignored;
        static_cast<void>(_lookupTimer.cancel(ignored));
    }

    void ConnectToAsync(const std::shared_ptr<ILink>& link, const Net::HostLookup::Addresses& results)
    {
        link->GetTcpStream().expires_after(_options.link.handshakeTimeout);
        link->GetTcpStream().async_connect(
            _addresses.Rotate(results),
            _addresses.MakeCondition(),
            [weak = weak_from_this(), link](ErrorCode error, const Tcp::endpoint& /*endpoint*/) {
                const auto self = weak.lock();
                if (self == nullptr || self->_linkOrNull != link)
                {
                    return;
                }
                if (error)
                {
                    link->Abort(
                        "cannot connect to " + self->_url.host + ":" + self->_url.port + ": " + error.message());
                    return;
                }
                self->_addresses.Reset();
                const std::string& host = self->_options.host.empty() ? self->_url.hostHeader : self->_options.host;
                link->HandshakeAsync({host, self->_url.target, self->_options.headers});
            });
    }

    LinkOwner MakeOwner()
    {
        const std::weak_ptr<Impl> weak = weak_from_this();
        LinkOwner owner;
        owner.onOpen = [weak] {
            if (const auto self = weak.lock())
            {
                self->_logger.Info("connected", {{"url", Core::MakeShownURL(self->_options.url)}});
                self->Run([](auto& session, Core::Now now, auto& out) { session.OnConnected(now, out); });
            }
        };
        owner.onText = [weak](std::string_view text) {
            if (const auto self = weak.lock())
            {
                self->Observe(EWireDirection::In, text);
                self->Run([text](auto& session, Core::Now now, auto& out) { session.OnText(text, now, out); });
            }
        };
        owner.onClosed = [weak](const std::string& reason) {
            if (const auto self = weak.lock())
            {
                self->_linkOrNull = nullptr;
                self->_logger.Debug(
                    "not connected",
                    {{"url", Core::MakeShownURL(self->_options.url)}, {"reason", reason}});
                self->Run([&reason](auto& session, Core::Now now, auto& out) { session.OnClosed(reason, now, out); });
            }
        };
        return owner;
    }
};

AcsClient::AcsClient(std::shared_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

AcsClient::~AcsClient()
{
    _impl->Detach();
}

Core::Result<std::unique_ptr<AcsClient>> AcsClient::Create(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    const ClientOptions& options,
    ISessionHandler& handler)
{
    Core::Result<WebSocketURL> url = ParseWebSocketURL(options.url);
    if (!url.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(url.error()));
    }
    Core::Result<void> headers =
        CheckHostHeader(options.host).and_then([&] { return CheckHttpHeaders(options.headers); });
    if (!headers.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(headers.error()));
    }
    Core::Result<std::unique_ptr<ITransport>> transport = MakeTransport(options, *url);
    if (!transport.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(transport.error()));
    }
    auto impl = std::make_shared<
        Impl>(executor, clock, random, logger, options, std::move(*url), std::move(*transport), handler);
    return std::unique_ptr<AcsClient>(new AcsClient(std::move(impl))); // the constructor is private
}

void AcsClient::Start()
{
    _impl->Run([](auto& session, Core::Now now, auto& out) { session.Start(now, out); });
}

void AcsClient::Stop()
{
    _impl->Run([](auto& session, Core::Now now, auto& out) { session.Stop(now, out); });
}

bool AcsClient::TrySendDurable(const Protocol::AcsRequest& request)
{
    bool bTaken = false;
    _impl->Run([&request, &bTaken](auto& session, Core::Now now, auto& out) {
        bTaken = session.TrySendDurable(request, now, out);
    });
    return bTaken;
}

void AcsClient::ReplayDone()
{
    _impl->Run([](auto& session, Core::Now now, auto& out) { session.ReplayDone(now, out); });
}

void AcsClient::SendStatus(const Protocol::AcsPayload& status)
{
    _impl->Run([&status](auto& session, Core::Now now, auto& out) { session.SendStatus(status, now, out); });
}

void AcsClient::SendPosition(const Protocol::RobotPositionUpdate& positions)
{
    _impl->Run([&positions](auto& session, Core::Now now, auto& out) { session.SendPosition(positions, now, out); });
}

void AcsClient::Answer(
    Protocol::EAcsCommand command,
    std::string_view transactionID,
    Protocol::EAckResult result,
    std::string_view message,
    const Protocol::AckPayload& payload)
{
    _impl->Run([&](auto& session, Core::Now now, auto& out) {
        session.Answer(command, transactionID, result, message, payload, now, out);
    });
}

void AcsClient::SetSiteOffset(std::chrono::minutes offset)
{
    _impl->SetSiteOffset(offset);
}

void AcsClient::SendText(std::string_view text)
{
    _impl->Run([text](auto& /*session*/, Core::Now /*now*/, auto& out) {
        out.emplace_back(Protocol::SendText{0, std::string(text), false});
    });
}

Core::Result<void> AcsClient::ReloadTLS()
{
    return _impl->ReloadTLS();
}

bool AcsClient::IsRegistered() const
{
    return _impl->GetSession().IsRegistered();
}

std::size_t AcsClient::GetRoom() const
{
    return _impl->GetSession().GetRoom();
}

const Protocol::SessionStatistics& AcsClient::GetStatistics() const
{
    return _impl->GetSession().GetStatistics();
}

} // namespace ACS::ProtocolBeast

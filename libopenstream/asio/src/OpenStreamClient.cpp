#include "SocketOptions.hpp"
#include <acs/net/AddressRotation.hpp>
#include <acs/net/HostLookup.hpp>
#include <acs/net/TimerArray.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamAsio
{

using OpenStream::ClientAction;
using OpenStream::ClientActions;
using OpenStream::ClientEvent;
using Tcp = boost::asio::ip::tcp;

class OpenStreamClient::Impl final : public std::enable_shared_from_this<OpenStreamClient::Impl>
{
    using Timers = Net::TimerArray<OpenStream::EClientTimer, OpenStream::CLIENT_TIMER_COUNT>;

    static constexpr std::size_t READ_BYTES = 64U * 1024U;

    Core::IClock& _clock;
    Core::Logger _logger;
    OpenStreamClientOptions _options;
    EventHandler _handler;
    OpenStream::ClientSession _session;
    ClientActions _actions;
    Net::HostLookup _lookup;
    Net::AddressRotation _addresses;
    Tcp::socket _socket;
    std::shared_ptr<Timers> _timers;
    std::array<char, READ_BYTES> _input{};
    std::uint64_t _connection = 0; ///< Handlers of an earlier connection do nothing.
    bool _bWrote = false;          ///< Since the last read.
    bool _bAcknowledging = false;  ///< At once, until the next write.
    bool _bExecuting = false;
    bool _bDown = false;
    bool _bWasReady = false;   ///< Since the last loss.
    bool _bLossLogged = false; ///< Of the current outage.

    /// Calls a method while the client and its connection exist. Not a lambda: the handlers of one operation start the next
    /// one, which is not a recursion.
    template <typename... TResults>
    class GuardedHandler
    {
    public:
        using Method = void (Impl::*)(TResults...);

    private:
        std::weak_ptr<Impl> _client;
        std::uint64_t _connection;
        Method _method;

    public:
        GuardedHandler(std::weak_ptr<Impl> client, std::uint64_t connection, Method method)
            : _client(std::move(client)),
              _connection(connection),
              _method(method)
        {
        }

        void operator()(TResults... results) const
        {
            const std::shared_ptr<Impl> self = _client.lock();
            if (self != nullptr && !self->_bDown && self->_connection == _connection)
            {
                (self.get()->*_method)(results...);
                self->Execute();
            }
        }
    };

public:
    Impl(
        const boost::asio::any_io_executor& executor,
        Core::IClock& clock,
        Core::IRandom& random,
        Core::Logger logger,
        OpenStreamClientOptions options,
        EventHandler handler)
        : _clock(clock),
          _logger(std::move(logger)),
          _options(std::move(options)),
          _handler(std::move(handler)),
          _session(_options.session, random),
          _lookup(executor),
          _socket(executor),
          _timers(std::make_shared<Timers>(executor, [this](OpenStream::EClientTimer timer) { OnTimer(timer); }))
    {
    }

    void Start()
    {
        _session.Start(_clock.GetNow(), _actions);
        Execute();
    }

    void Stop()
    {
        _session.Stop(_clock.GetNow(), _actions);
        Execute();
    }

    void SetMonitor(std::optional<OpenStream::MonitorRequest> monitorOrNull)
    {
        _session.SetMonitor(std::move(monitorOrNull), _clock.GetNow(), _actions);
        Execute();
    }

    std::uint64_t SendControl(const OpenStream::ControlRequest& request, OpenStream::EControlTracking tracking)
    {
        const std::uint64_t token = _session.SendControl(request, tracking, _clock.GetNow(), _actions);
        Execute();
        return token;
    }

    std::uint64_t SendControlCall(OpenStream::ControlCall call)
    {
        const std::uint64_t token = _session.SendControlCall(std::move(call), _clock.GetNow(), _actions);
        Execute();
        return token;
    }

    void StopControl()
    {
        _session.StopControl(_clock.GetNow(), _actions);
        Execute();
    }

    void ShutDown()
    {
        _bDown = true;
        _lookup.Cancel();
        _timers->CancelAll();
        CloseSocket();
    }

    [[nodiscard]] const OpenStream::ClientSession& GetSession() const noexcept
    {
        return _session;
    }

private:
    template <typename... TResults>
    [[nodiscard]] GuardedHandler<TResults...> Guard(void (Impl::*method)(TResults...))
    {
        return GuardedHandler<TResults...>(weak_from_this(), _connection, method);
    }

    /// Carries out the batch. What the event handler asks for from within joins the batch.
    void Execute()
    {
        if (_bExecuting)
        {
            return;
        }
        const std::shared_ptr<Impl> self = shared_from_this(); // the handler may destroy the client
        _bExecuting = true;
        for (std::size_t index = 0; index < _actions.size() && !_bDown; ++index)
        {
            const ClientAction action = std::move(_actions[index]);
            std::visit([this](const auto& content) { Do(content); }, action);
        }
        _actions.clear();
        _bExecuting = false;
    }

    void Do(const ClientEvent& event)
    {
        if (const auto* lost = std::get_if<OpenStream::ClientLost>(&event))
        {
            LogLoss(lost->detail);
        }
        else if (std::holds_alternative<OpenStream::ClientReady>(event))
        {
            _bWasReady = true;
            _bLossLogged = false;
        }
        _handler(event, _clock.GetNow());
    }

    /// Once per outage: the further tries fail for the same reason.
    void LogLoss(const std::string& reason)
    {
        const std::string_view sentence = std::exchange(_bWasReady, false)
            ? "lost the Open Stream session, trying again until the server answers"
            : "no Open Stream session: start the server or correct its address; trying again until it answers";
        _logger.Write(
            std::exchange(_bLossLogged, true) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
            sentence,
            {{"host", _options.host}, {"port", std::to_string(_options.port)}, {"reason", reason}});
    }

    void Do(const OpenStream::ClientConnect& /*action*/)
    {
        ++_connection;
        _lookup.ResolveAsync(_options.host, std::to_string(_options.port), Guard(&Impl::OnResolved));
    }

    void OnResolved(const boost::system::error_code& error, const Net::HostLookup::Addresses& found)
    {
        if (error)
        {
            ReportConnectFailure(error);
            return;
        }
        boost::asio::async_connect(
            _socket,
            _addresses.Rotate(found),
            _addresses.MakeCondition(),
            Guard(&Impl::OnConnectDone));
    }

    void ReportConnectFailure(const boost::system::error_code& error)
    {
        const std::string detail =
            fmt::format("cannot connect to {}:{}: {}", _options.host, _options.port, error.message());
        _session.OnConnectFailed(detail, _clock.GetNow(), _actions);
    }

    void OnConnectDone(const boost::system::error_code& error, const Tcp::endpoint& /*endpoint*/)
    {
        if (error)
        {
            ReportConnectFailure(error);
            return;
        }
        _addresses.Reset();
        SetSocketOptions(_socket);
        DropUnsentAtClose(_socket); // an old CONTROL must not move anything
        ReadMoreAsync();
        _session.OnConnected(_clock.GetNow(), _actions);
    }

    void ReadMoreAsync()
    {
        _socket.async_read_some(boost::asio::buffer(_input), Guard(&Impl::OnRead));
    }

    void OnRead(const boost::system::error_code& error, std::size_t size)
    {
        const Core::Now now = _clock.GetNow();
        if (error == boost::asio::error::eof)
        {
            _session.OnPeerClosed(now, _actions);
            return;
        }
        if (error)
        {
            _session.OnSocketError(error.message(), now, _actions);
            return;
        }
        AcknowledgeAtOnce();
        if (_options.onReceived)
        {
            _options.onReceived(std::string_view(_input.data(), size));
        }
        const std::uint64_t connection = _connection;
        _session.OnBytes(std::string_view(_input.data(), size), now, _actions);
        Execute();
        if (!_bDown && _connection == connection)
        {
            ReadMoreAsync();
        }
    }

    /// After a write, the system delays the acknowledgement of every other line until the next write, or 40 ms. So every
    /// second read takes longer, and a controller that buffers small lines until then (Nagle) stalls. A client that only
    /// reads therefore requests immediate acknowledgements until it writes again.
    void AcknowledgeAtOnce()
    {
        if (!std::exchange(_bWrote, false) && !std::exchange(_bAcknowledging, true))
        {
            SetQuickAcknowledgement(_socket);
        }
    }

    void Do(const OpenStream::ClientSend& action)
    {
        if (_options.maySend && !_options.maySend())
        {
            boost::asio::post(_socket.get_executor(), [handler = Guard(&Impl::OnWritten)]() mutable {
                handler(boost::asio::error::operation_aborted, 0);
            });
            return;
        }
        _bWrote = true;
        _bAcknowledging = false;
        if (_options.onSent)
        {
            _options.onSent(action.text);
        }
        boost::asio::async_write(_socket, boost::asio::buffer(action.text), Guard(&Impl::OnWritten));
    }

    void OnWritten(const boost::system::error_code& error, std::size_t /*size*/)
    {
        if (error)
        {
            _session.OnSocketError(error.message(), _clock.GetNow(), _actions);
        }
        else
        {
            _session.OnSendCompleted(_clock.GetNow(), _actions);
        }
    }

    void Do(const OpenStream::ClientClose& /*action*/)
    {
        ++_connection;
        _lookup.Cancel();
        CloseSocket();
    }

    void CloseSocket()
    {
        CloseInPeaceWhenAllArrived(_socket);
        boost::system::error_code ignored;
        static_cast<void>(_socket.close(ignored));
    }

    void Do(const OpenStream::ClientStartTimer& action)
    {
        _timers->Start(action.timer, action.deadline - _clock.GetNow().steady);
    }

    void OnTimer(OpenStream::EClientTimer timer)
    {
        _session.OnTimer(timer, _clock.GetNow(), _actions);
        Execute();
    }

    void Do(const OpenStream::ClientCancelTimer& action)
    {
        _timers->Cancel(action.timer);
    }
};

OpenStreamClient::OpenStreamClient(
    const boost::asio::any_io_executor& executor,
    Core::IClock& clock,
    Core::IRandom& random,
    Core::Logger logger,
    OpenStreamClientOptions options,
    EventHandler handler)
    : _impl(std::make_shared<Impl>(executor, clock, random, std::move(logger), std::move(options), std::move(handler)))
{
}

OpenStreamClient::~OpenStreamClient()
{
    _impl->ShutDown();
}

void OpenStreamClient::Start()
{
    _impl->Start();
}

void OpenStreamClient::Stop()
{
    _impl->Stop();
}

void OpenStreamClient::SetMonitor(std::optional<OpenStream::MonitorRequest> monitorOrNull)
{
    _impl->SetMonitor(std::move(monitorOrNull));
}

std::uint64_t OpenStreamClient::SendControl(
    const OpenStream::ControlRequest& request,
    OpenStream::EControlTracking tracking)
{
    return _impl->SendControl(request, tracking);
}

std::uint64_t OpenStreamClient::SendControlCall(OpenStream::ControlCall call)
{
    return _impl->SendControlCall(std::move(call));
}

void OpenStreamClient::StopControl()
{
    _impl->StopControl();
}

OpenStream::EClientState OpenStreamClient::GetState() const noexcept
{
    return _impl->GetSession().GetState();
}

const OpenStream::ClientSessionStats& OpenStreamClient::GetStats() const noexcept
{
    return _impl->GetSession().GetStats();
}

const OpenStream::ClientData* OpenStreamClient::GetLatestOrNull() const noexcept
{
    return _impl->GetSession().GetLatestOrNull();
}

OpenStream::StreamQuality OpenStreamClient::GetQuality() const
{
    return _impl->GetSession().GetQuality();
}

} // namespace ACS::OpenStreamAsio

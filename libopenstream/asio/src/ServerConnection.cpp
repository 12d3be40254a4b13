#include "ServerConnection.hpp"

#include "HandlerAllocator.hpp"
#include "SocketOptions.hpp"

#include <boost/asio/bind_allocator.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>

#include <functional>
#include <utility>

namespace ACS::OpenStreamAsio
{

namespace
{

std::string DescribePeer(const boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code error;
    const boost::asio::ip::tcp::endpoint peer = socket.remote_endpoint(error);
    return error ? "unknown" : fmt::format("{}:{}", peer.address().to_string(), peer.port());
}

std::string_view GetReasonText(OpenStream::EServerCloseReason reason)
{
    using OpenStream::EServerCloseReason;
    switch (reason)
    {
        case EServerCloseReason::PeerClosed:
            return "the client closed";
        case EServerCloseReason::StopSession:
            return "STOP session";
        case EServerCloseReason::HandshakeTimeout:
            return "no HANDSHAKE in time";
        case EServerCloseReason::IdleTimeout:
            return "idle for too long";
        case EServerCloseReason::StreamingTimeout:
            return "the stream was interrupted for too long";
        case EServerCloseReason::LineTooLong:
            return "a line beyond the limit";
        case EServerCloseReason::OutputFull:
            return "the client does not read";
        case EServerCloseReason::Rejected:
            return "rejected";
        case EServerCloseReason::SocketError:
            return "the connection broke";
        default:
            return "unknown";
    }
}

} // namespace

ServerConnection::ServerConnection(
    boost::asio::ip::tcp::socket socket,
    Core::IClock& clock,
    Core::Logger logger,
    const OpenStreamServerOptions& options,
    std::uint64_t number,
    OpenStream::IOpenApiService& service,
    Handlers handlers)
    : _socket(std::move(socket)),
      _clock(clock),
      _logger(std::move(logger)),
      _number(number),
      _onReceived(options.onReceived),
      _onSent(options.onSent),
      _onEnded(options.onClosed),
      _service(_socket.get_executor(), service, [this](const ServiceCaller::Answer& answer) { OnAnswerDue(answer); }),
      _handlers(std::move(handlers)),
      _peer(DescribePeer(_socket)),
      _session(options.session),
      _timers(
          std::make_shared<Timers>(_socket.get_executor(), [this](OpenStream::EServerTimer timer) { OnTimer(timer); }))
{
}

void ServerConnection::Start()
{
    SetSocketOptions(_socket);
    _logger.Info("an Open Stream client connected", {{"peer", _peer}});
    _session.Start(_clock.GetNow(), _actions);
    Execute();
    ReadMoreAsync();
}

void ServerConnection::Reject(std::string_view message)
{
    SetSocketOptions(_socket);
    _logger.Warning("an Open Stream client was rejected", {{"peer", _peer}, {"reason", message}});
    _session.Reject(message, _clock.GetNow(), _actions);
    Execute();
    ReadMoreAsync();
}

void ServerConnection::Abort()
{
    const bool bEnds = !std::exchange(_bClosed, true);
    _timers->CancelAll();
    _service.Cancel();
    boost::system::error_code ignored;
    static_cast<void>(_socket.close(ignored));
    if (bEnds && _onEnded)
    {
        _onEnded(_number);
    }
}

OpenStream::EServerState ServerConnection::GetState() const noexcept
{
    return _session.GetState();
}

bool ServerConnection::HasControl() const noexcept
{
    return _session.HasControl();
}

const OpenStream::ServerSessionStats& ServerConnection::GetStats() const noexcept
{
    return _session.GetStats();
}

/// Carries out the batch. What it leads to at once (the answer of a service) joins the batch.
void ServerConnection::Execute()
{
    for (std::size_t index = 0; index < _actions.size() && !_bClosed; ++index)
    {
        const OpenStream::ServerAction action = _actions[index];
        std::visit([this](const auto& content) { Do(content); }, action);
    }
    _actions.clear();
}

void ServerConnection::Do(const OpenStream::ServerSend& action)
{
    if (_onSent)
    {
        _onSent(_number, action.text);
    }
    boost::asio::async_write(
        _socket,
        boost::asio::buffer(action.text),
        boost::asio::bind_allocator(
            HandlerAllocator<std::byte>(_writeMemory),
            std::bind_front(&ServerConnection::OnWritten, shared_from_this())));
}

void ServerConnection::OnWritten(const boost::system::error_code& error, std::size_t /*size*/)
{
    if (_bClosed)
    {
        return;
    }
    if (error)
    {
        _session.OnSocketError(_actions);
    }
    else
    {
        _session.OnSendCompleted(_clock.GetNow(), _actions);
    }
    Execute();
}

void ServerConnection::Do(const OpenStream::ServerCall& action)
{
    const ServiceCaller::Answer& answer = _service.Call(action, _clock.GetNow());
    if (!_bClosed && !_service.TryDelay(answer))
    {
        _session.OnServiceAnswer(answer.token, answer.response, _clock.GetNow(), _actions);
    }
}

void ServerConnection::OnAnswerDue(const ServiceCaller::Answer& answer)
{
    const std::shared_ptr<ServerConnection> self = shared_from_this(); // the closed handler lets go of it
    _session.OnServiceAnswer(answer.token, answer.response, _clock.GetNow(), _actions);
    Execute();
}

void ServerConnection::Do(const OpenStream::ServerStopControl& action)
{
    if (action.bControls || !_handlers.isOtherInControl(*this))
    {
        _service.StopControl(_clock.GetNow());
    }
}

void ServerConnection::Do(const OpenStream::ServerStartTimer& action)
{
    _timers->Start(action.timer, action.deadline - _clock.GetNow().steady);
}

void ServerConnection::OnTimer(OpenStream::EServerTimer timer)
{
    const std::shared_ptr<ServerConnection> self = shared_from_this(); // the closed handler lets go of it
    _session.OnTimer(timer, _clock.GetNow(), _actions);
    Execute();
}

void ServerConnection::Do(const OpenStream::ServerCancelTimer& action)
{
    _timers->Cancel(action.timer);
}

void ServerConnection::Do(const OpenStream::ServerPauseReading& /*action*/)
{
    _bPaused = true;
}

void ServerConnection::Do(const OpenStream::ServerResumeReading& /*action*/)
{
    _bPaused = false;
    ReadMoreAsync();
}

void ServerConnection::Do(const OpenStream::ServerContinue& /*action*/)
{
    boost::asio::post(_socket.get_executor(), std::bind_front(&ServerConnection::OnContinue, shared_from_this()));
}

void ServerConnection::OnContinue()
{
    if (!_bClosed)
    {
        _session.OnContinue(_clock.GetNow(), _actions);
        Execute();
    }
}

void ServerConnection::Do(const OpenStream::ServerShutdownSend& /*action*/)
{
    boost::system::error_code ignored;
    static_cast<void>(_socket.shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored));
}

void ServerConnection::Do(const OpenStream::ServerClose& action)
{
    _logger.Info("an Open Stream session ended", {{"peer", _peer}, {"reason", GetReasonText(action.reason)}});
    Abort();
    _handlers.onClosed(*this);
}

void ServerConnection::ReadMoreAsync()
{
    if (_bReading || _bPaused || _bPeerClosed || _bClosed)
    {
        return;
    }
    _bReading = true;
    _socket.async_read_some(
        boost::asio::buffer(_input),
        std::bind_front(&ServerConnection::OnRead, shared_from_this()));
}

void ServerConnection::OnRead(const boost::system::error_code& error, std::size_t size)
{
    _bReading = false;
    if (_bClosed)
    {
        return;
    }
    if (error == boost::asio::error::eof)
    {
        _bPeerClosed = true;
        _session.OnPeerClosed(_clock.GetNow(), _actions);
    }
    else if (error)
    {
        _session.OnSocketError(_actions);
    }
    else
    {
        const std::string_view bytes(_input.data(), size);
        if (_onReceived)
        {
            _onReceived(_number, bytes);
        }
        _session.OnBytes(bytes, _clock.GetNow(), _actions);
    }
    Execute();
    ReadMoreAsync();
}

} // namespace ACS::OpenStreamAsio

#include "ClientSession.Impl.hpp"

#include "ClientEvents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

std::string Describe(const ErrorLine& error)
{
    return fmt::format("{}: {}{}{}", error.codeText, error.message, error.hint.empty() ? "" : "; hint: ", error.hint);
}

} // namespace

using Detail::Report;

ClientSession::Impl::Impl(const ClientSessionOptions& options, Core::IRandom& random)
    : _options(options),
      _random(random),
      _backoff(options.reconnect),
      _framer(options.longestLine),
      _outbox(options.maximumOutput),
      _controls(options.maximumControls)
{
}

void ClientSession::Impl::Start(Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Stopped)
    {
        _backoff.Reset();
        Connect(now, out);
    }
}

void ClientSession::Impl::Connect(Core::Now now, ClientActions& out)
{
    _framer.Reset();
    _outbox.Reset();
    _stopMark = 0;
    _waitingDue = Core::SteadyTime::max();
    _sendingDue = Core::SteadyTime::max();
    _state = EClientState::Connecting;
    out.emplace_back(ClientStartTimer{EClientTimer::Connect, now.steady + _options.connectTimeout});
    out.emplace_back(ClientConnect{});
}

void ClientSession::Impl::Stop(Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Stopped || _state == EClientState::Ending)
    {
        return;
    }
    if (_state != EClientState::Ready)
    {
        End(out);
        return;
    }
    SettleInFlight(EControlOutcome::Unknown, "the session was stopped", out);
    SettleWaiting("the session was stopped", out);
    _state = EClientState::Ending;
    SendAwaited(StopRequest{EStopTarget::Session}, EInFlight::StopSession, now, out);
}

void ClientSession::Impl::OnConnected(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Connecting)
    {
        return;
    }
    out.emplace_back(ClientCancelTimer{EClientTimer::Connect});
    _state = EClientState::Handshaking;
    SendAwaited(HandshakeRequest{}, EInFlight::Handshake, now, out);
}

void ClientSession::Impl::OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Connecting)
    {
        HandleLoss(EClientLossReason::ConnectFailed, detail, now, out);
    }
}

void ClientSession::Impl::OnBytes(std::string_view bytes, Core::Now now, ClientActions& out)
{
    if (!IsConnected())
    {
        return;
    }
    _framer.Feed(bytes);
    while (IsConnected())
    {
        const std::optional<std::string_view> line = _framer.TakeLineOrNull();
        if (!line.has_value())
        {
            break;
        }
        ProcessLine(*line, now, out);
    }
    _framer.Keep();
    if (IsConnected() && _framer.HasOverflown())
    {
        HandleLoss(EClientLossReason::LineTooLong, "the controller sent a line beyond the limit", now, out);
    }
}

void ClientSession::Impl::ProcessLine(std::string_view text, Core::Now now, ClientActions& out)
{
    Core::Result<OpenStreamLine> line = _codec.DecodeLine(text);
    if (!line.has_value())
    {
        ++_stats.badLines;
        Report(ClientBadLine{Core::Describe(line.error())}, out);
        return;
    }
    std::visit([this, now, &out](auto& content) { Handle(content, now, out); }, *line);
}

void ClientSession::Impl::Handle(HandshakeAck& ack, Core::Now now, ClientActions& out)
{
    if (_inFlight != EInFlight::Handshake)
    {
        return;
    }
    if (!ack.bOk)
    {
        HandleLoss(EClientLossReason::HandshakeFailed, "the controller did not accept the HANDSHAKE", now, out);
        return;
    }
    FinishInFlight(out);
    ++_stats.connects;
    _backoff.Reset();
    _state = EClientState::Ready;
    _bMonitorOn = false;
    _startedMonitorNumber = 0;
    _bMonitorStopFirst = false;
    _bMonitorDue = _monitor.has_value();
    Report(ClientReady{std::move(ack.version)}, out);
    SendNext(now, out);
}

void ClientSession::Impl::Handle(StopAck& ack, Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Ending && ack.target == EStopTarget::Session)
    {
        End(out);
        return;
    }
    if (_state != EClientState::Ready)
    {
        return;
    }
    if (IsAwaited(EInFlight::StopMonitor) && ack.target == EStopTarget::Monitor)
    {
        FinishInFlight(out);
        _bMonitorOn = false;
        _bMonitorStopFirst = false;
    }
    Report(ClientStopped{ack.target}, out);
    SendNext(now, out);
}

void ClientSession::Impl::Handle(ErrorLine& error, Core::Now now, ClientActions& out)
{
    switch (_state)
    {
        case EClientState::Handshaking:
            HandleLoss(EClientLossReason::HandshakeFailed, Describe(error), now, out);
            break;
        case EClientState::Ready:
            HandleErrorWhenReady(error, now, out);
            break;
        case EClientState::Ending:
            End(out);
            break;
        case EClientState::Stopped:
        case EClientState::Connecting:
        case EClientState::Waiting:
            break;
        default:
            assert(false && "unhandled EClientState");
            break;
    }
}

void ClientSession::Impl::HandleErrorWhenReady(ErrorLine& error, Core::Now now, ClientActions& out)
{
    const EErrorScope scope = GetErrorScope(error.code);
    const bool bOfRequest = scope == EErrorScope::Request;
    if (scope == EErrorScope::Fatal)
    {
        HandleLoss(EClientLossReason::SessionEnded, Describe(error), now, out);
        return;
    }
    if (IsAwaited(EInFlight::Monitor) && (bOfRequest || scope == EErrorScope::Monitor))
    {
        HandleMonitorError(error, out);
    }
    else if (scope == EErrorScope::Stop || (bOfRequest && IsAwaited(EInFlight::StopMonitor)))
    {
        HandleStopError(error, out);
    }
    else if (bOfRequest || scope == EErrorScope::Control)
    {
        RefuseControl(GetErrorStatus(error.code), std::nullopt, Describe(error), out);
    }
    else
    {
        Report(ClientErrorReported{std::move(error)}, out);
    }
    SendNext(now, out);
}

void ClientSession::Impl::HandleStopError(ErrorLine& error, ClientActions& out)
{
    const bool bOfMonitor = IsAwaited(EInFlight::StopMonitor);
    if (bOfMonitor)
    {
        FinishInFlight(out);
        _bMonitorOn = false;
        _bMonitorStopFirst = false;
    }
    if (error.code == EOpenStreamErrorCode::NothingToStop)
    {
        Report(ClientStopped{bOfMonitor ? EStopTarget::Monitor : EStopTarget::Control}, out);
    }
    else
    {
        Report(ClientErrorReported{std::move(error)}, out);
    }
}

void ClientSession::Impl::FinishInFlight(ClientActions& out)
{
    _inFlight = EInFlight::Nothing;
    out.emplace_back(ClientCancelTimer{EClientTimer::Answer});
}

/// One command in flight at a time: the MONITOR precedes the CONTROLs.
void ClientSession::Impl::SendNext(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || _inFlight != EInFlight::Nothing || TrySendMonitor(now, out))
    {
        return;
    }
    if (std::optional<PendingControl> control = _controls.PopFrontOrNull())
    {
        SendControlInTurn(std::move(*control), out);
    }
}

void ClientSession::Impl::SendNow(const OpenStreamRequest& request, ClientActions& out)
{
    OpenStreamCodec::EncodeRequest(request, _outbox.GetLines());
    Flush(out);
}

bool ClientSession::Impl::IsAwaited(EInFlight kind) const noexcept
{
    return _inFlight == kind && _outbox.WasTaken(_inFlightMark);
}

void ClientSession::Impl::SendAwaited(
    const OpenStreamRequest& request,
    EInFlight kind,
    Core::Now now,
    ClientActions& out)
{
    _inFlight = kind;
    out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.answerTimeout});
    SendNow(request, out);
    _inFlightMark = _outbox.GetMark();
}

void ClientSession::Impl::Flush(ClientActions& out)
{
    if (const std::string_view text = _outbox.TakeForSend(); !text.empty())
    {
        _sendingDue = std::exchange(_waitingDue, Core::SteadyTime::max());
        out.emplace_back(ClientSend{text});
    }
}

void ClientSession::Impl::OnSendCompleted(Core::Now now, ClientActions& out)
{
    if (!IsConnected() || !_outbox.IsSending())
    {
        return;
    }
    static_cast<void>(_outbox.CompleteSend());
    _sendingDue = Core::SteadyTime::max();
    if (_inFlight == EInFlight::Control && !_bControlLeft && _outbox.WasSent(_inFlightMark))
    {
        _bControlLeft = true;
        _controlLeftAt = now.steady;
        out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.controlWindow});
    }
    Flush(out);
}

void ClientSession::Impl::OnPeerClosed(Core::Now now, ClientActions& out)
{
    Disconnect(EClientLossReason::PeerClosed, "the controller closed the connection", now, out);
}

void ClientSession::Impl::OnSocketError(std::string_view detail, Core::Now now, ClientActions& out)
{
    Disconnect(EClientLossReason::SocketError, detail, now, out);
}

void ClientSession::Impl::Disconnect(
    EClientLossReason reason,
    std::string_view detail,
    Core::Now now,
    ClientActions& out)
{
    if (_state == EClientState::Ending)
    {
        End(out);
    }
    else if (IsConnected())
    {
        HandleLoss(reason, detail, now, out);
    }
}

void ClientSession::Impl::OnTimer(EClientTimer timer, Core::Now now, ClientActions& out)
{
    switch (timer)
    {
        case EClientTimer::Connect:
            if (_state == EClientState::Connecting)
            {
                HandleLoss(EClientLossReason::ConnectTimeout, "the connection was not made in time", now, out);
            }
            break;
        case EClientTimer::Answer:
            OnAnswerTimeout(now, out);
            break;
        case EClientTimer::DataAge:
            _bDataAgeArmed = false;
            CheckDataAge(now, out);
            break;
        case EClientTimer::Control:
            _bControlTimerArmed = false;
            CheckControls(now, out);
            break;
        case EClientTimer::Retry:
            if (_state == EClientState::Waiting)
            {
                Connect(now, out);
            }
            break;
        default:
            assert(false && "unhandled EClientTimer");
            break;
    }
}

void ClientSession::Impl::OnAnswerTimeout(Core::Now now, ClientActions& out)
{
    switch (_inFlight)
    {
        case EInFlight::Nothing:
            break;
        case EInFlight::Control:
            FinishControlWindow(now, out);
            SendNext(now, out);
            break;
        case EInFlight::StopSession:
            End(out);
            break;
        case EInFlight::Handshake:
        case EInFlight::Monitor:
        case EInFlight::StopMonitor:
            HandleLoss(EClientLossReason::AnswerTimeout, "the controller did not answer in time", now, out);
            break;
        default:
            assert(false && "unhandled EInFlight");
            break;
    }
}

bool ClientSession::Impl::IsConnected() const noexcept
{
    return _state == EClientState::Handshaking || _state == EClientState::Ready || _state == EClientState::Ending;
}

void ClientSession::Impl::HandleLoss(
    EClientLossReason reason,
    std::string_view detail,
    Core::Now now,
    ClientActions& out)
{
    // The detail may be in the buffers that the next connection uses.
    std::string reasonText(detail);
    DropConnection(detail, out);
    _state = EClientState::Waiting;
    const std::chrono::milliseconds delay = _backoff.GetNextDelay(_random);
    out.emplace_back(ClientStartTimer{EClientTimer::Retry, now.steady + delay});
    Report(ClientLost{reason, std::move(reasonText), delay}, out);
}

void ClientSession::Impl::DropConnection(std::string_view detail, ClientActions& out)
{
    const bool bLeft = _outbox.WasTaken(_inFlightMark);
    SettleInFlight(bLeft ? EControlOutcome::Unknown : EControlOutcome::NotSent, detail, out);
    SettleConfirmations(detail, out);
    SettleWaiting(detail, out);
    _inFlight = EInFlight::Nothing;
    _latest.reset();
    _bControlTimerArmed = false;
    _bMonitorOn = false;
    _bStale = false;
    _bDataAgeArmed = false;
    for (const EClientTimer timer :
         {EClientTimer::Connect,
          EClientTimer::Answer,
          EClientTimer::DataAge,
          EClientTimer::Retry,
          EClientTimer::Control})
    {
        out.emplace_back(ClientCancelTimer{timer});
    }
    out.emplace_back(ClientClose{});
}

void ClientSession::Impl::End(ClientActions& out)
{
    DropConnection("the session was stopped", out);
    _state = EClientState::Stopped;
    Report(ClientEnded{}, out);
}

EClientState ClientSession::Impl::GetState() const noexcept
{
    return _state;
}

const ClientSessionStats& ClientSession::Impl::GetStats() const noexcept
{
    return _stats;
}

} // namespace ACS::OpenStream

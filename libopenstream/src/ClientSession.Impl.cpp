#include "ClientSession.Impl.hpp"

#include "ClientEvents.hpp"

#include <fmt/format.h>

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
      _output(options.maximumOutput),
      _monitor(_options),
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
    _output.Reset();
    _stops = 0;
    _stopsBeforeMonitor = 0;
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
    _controls.SettleCurrent(EControlOutcome::Unknown, "the session was stopped", out);
    _controls.SettleWaiting("the session was stopped", out);
    _state = EClientState::Ending;
    SendAwaited(StopRequest{EStopTarget::Session}, now, out);
}

void ClientSession::Impl::OnConnected(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Connecting)
    {
        return;
    }
    out.emplace_back(ClientCancelTimer{EClientTimer::Connect});
    _state = EClientState::Handshaking;
    SendAwaited(HandshakeRequest{}, now, out);
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
        Disconnect(EClientLossReason::LineTooLong, "the controller sent a line beyond the limit", now, out);
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
    if (_state != EClientState::Handshaking)
    {
        return;
    }
    if (!ack.bOk)
    {
        HandleLoss(EClientLossReason::HandshakeFailed, "the controller did not accept the HANDSHAKE", now, out);
        return;
    }
    out.emplace_back(ClientCancelTimer{EClientTimer::Answer});
    ++_stats.connects;
    _backoff.Reset();
    _state = EClientState::Ready;
    Report(ClientReady{std::move(ack.version)}, out);
    SendNext(now, out);
}

void ClientSession::Impl::Handle(MonitorAck& /*ack*/, Core::Now now, ClientActions& out)
{
    const bool bExpected = _monitor.IsRefused() || (_monitor.IsStarting() && _output.WasCommandTaken());
    if (_state == EClientState::Ready && bExpected)
    {
        _monitor.OnStarted(now, out);
        SendNext(now, out);
    }
}

void ClientSession::Impl::Handle(DataLine& line, Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || !_monitor.IsWanted())
    {
        return; // still on its way when the stream was stopped
    }
    ++_stats.dataLines;
    _controls.OnSample(line, out);
    _stats.missingLines += _monitor.OnSample(std::move(line), now, out);
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
    if (ack.target == EStopTarget::Monitor && _monitor.IsStopping() && _output.WasCommandTaken())
    {
        _monitor.OnStopped(out);
        _stops -= std::exchange(_stopsBeforeMonitor, 0); // Whatever became of their answers.
    }
    else if (ack.target == EStopTarget::Control)
    {
        CountStopAnswer();
    }
    Report(ClientStopped{ack.target}, out);
    SendNext(now, out);
}

void ClientSession::Impl::Handle(ControlError& error, Core::Now now, ClientActions& out)
{
    RefuseControl(
        error.status,
        std::move(error.body),
        fmt::format("the controller refused the CONTROL with status {}", error.status),
        out);
    SendNext(now, out);
}

void ClientSession::Impl::RefuseControl(
    int status,
    std::optional<Core::JsonText> bodyOrNull,
    std::string detail,
    ClientActions& out)
{
    if (_controls.IsInFlight() && _output.WasCommandTaken())
    {
        _controls.Refuse(status, std::move(bodyOrNull), std::move(detail), out);
    }
    else
    {
        Report(ClientControlFault{status, std::move(bodyOrNull), std::move(detail)}, out);
    }
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
    const bool bTaken = _output.WasCommandTaken();
    if (scope == EErrorScope::Fatal)
    {
        HandleLoss(EClientLossReason::SessionEnded, Describe(error), now, out);
        return;
    }
    if (_monitor.IsStarting() && bTaken && (bOfRequest || scope == EErrorScope::Monitor))
    {
        _monitor.OnRefused(std::move(error), out);
    }
    else if (scope == EErrorScope::Stop || (bOfRequest && _monitor.IsStopping() && bTaken))
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
    const bool bNothing = error.code == EOpenStreamErrorCode::NothingToStop;
    const bool bOfMonitor =
        _monitor.IsStopping() && _output.WasCommandTaken() && !(bNothing && _stopsBeforeMonitor > 0);
    if (bOfMonitor)
    {
        _monitor.OnStopped(out);
    }
    if (bNothing)
    {
        if (!bOfMonitor)
        {
            CountStopAnswer();
        }
        Report(ClientStopped{bOfMonitor ? EStopTarget::Monitor : EStopTarget::Control}, out);
    }
    else
    {
        Report(ClientErrorReported{std::move(error)}, out);
    }
}

/// A STOP control was answered; the server answers in order.
void ClientSession::Impl::CountStopAnswer() noexcept
{
    _stops -= _stops > 0 ? 1U : 0U;
    _stopsBeforeMonitor -= _stopsBeforeMonitor > 0 ? 1U : 0U;
}

void ClientSession::Impl::OnSendCompleted(Core::Now now, ClientActions& out)
{
    if (!IsConnected() || !_output.TryCompleteSend())
    {
        return;
    }
    if (_output.WasCommandSent() && _controls.TryBeginWindow(now))
    {
        out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.controlWindow});
    }
    _output.Flush(out);
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
            if (_state == EClientState::Ready && !_monitor.TryAwaitData(now, out))
            {
                HandleLoss(EClientLossReason::DataSilent, "the controller sent no data", now, out);
            }
            break;
        case EClientTimer::Control:
            _controlTimer.Reset();
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
    if (_state == EClientState::Ending)
    {
        End(out);
    }
    else if (_state == EClientState::Handshaking || _monitor.IsInFlight())
    {
        HandleLoss(EClientLossReason::AnswerTimeout, "the controller did not answer in time", now, out);
    }
    else if (_controls.IsInFlight())
    {
        if (!_controls.TryAccept(out))
        {
            CheckControls(now, out);
        }
        SendNext(now, out);
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
    const bool bTaken = _output.WasCommandTaken();
    _controls.SettleCurrent(bTaken ? EControlOutcome::Unknown : EControlOutcome::NotSent, detail, out);
    _controls.SettleConfirmations(detail, out);
    _controls.SettleWaiting(detail, out);
    _controlTimer.Reset();
    _monitor.OnDisconnected();
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

const ClientData* ClientSession::Impl::GetLatestOrNull() const noexcept
{
    return _monitor.GetLatestOrNull();
}

StreamQuality ClientSession::Impl::GetQuality() const
{
    return _monitor.GetQuality();
}

} // namespace ACS::OpenStream

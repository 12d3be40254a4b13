#include <acs/openstream/ClientSession.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

std::string Describe(const ErrorLine& error)
{
    return fmt::format("{}: {}{}{}", error.codeText, error.message, error.hint.empty() ? "" : "; hint: ", error.hint);
}

template <typename TEvent>
void Report(TEvent event, ClientActions& out)
{
    out.emplace_back(ClientEvent(std::move(event)));
}

} // namespace

ClientSession::ClientSession(const ClientSessionOptions& options, Core::IRandom& random)
    : _options(options),
      _random(random),
      _backoff(options.reconnect),
      _framer(options.longestLine),
      _outbox(options.maximumOutput),
      _controls(options.maximumControls)
{
}

void ClientSession::Start(Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Stopped)
    {
        _backoff.Reset();
        Connect(now, out);
    }
}

void ClientSession::Connect(Core::Now now, ClientActions& out)
{
    _framer.Reset();
    _outbox.Reset();
    _state = EClientState::Connecting;
    out.emplace_back(ClientStartTimer{EClientTimer::Connect, now.steady + _options.connectTimeout});
    out.emplace_back(ClientConnect{});
}

void ClientSession::Stop(Core::Now now, ClientActions& out)
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

void ClientSession::SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out)
{
    _monitor = std::move(monitorOrNull);
    if (_monitor.has_value())
    {
        _monitor->period = std::clamp(_monitor->period, MINIMUM_PERIOD, MAXIMUM_PERIOD);
    }
    _bMonitorDue = true;
    SendNext(now, out);
}

std::uint64_t ClientSession::SendControl(
    const ControlRequest& request,
    EControlTracking tracking,
    Core::Now now,
    ClientActions& out)
{
    const std::uint64_t token = ++_lastToken;
    const bool bReady = _state == EClientState::Ready && !_outbox.IsFull();
    const std::string_view obstacle = bReady ? "too many CONTROLs wait" : "there is no session with the controller";
    if (tracking == EControlTracking::Streamed)
    {
        if (bReady)
        {
            SendNow(request, out);
        }
        else
        {
            Report(ClientControlFault{0, std::nullopt, fmt::format("not sent: {}", obstacle)}, out);
        }
        return token;
    }
    if (!bReady || !_controls.TryPush(PendingControl{token, request}))
    {
        Report(ClientControlSettled{token, EControlOutcome::NotSent, 0, std::nullopt, std::string(obstacle)}, out);
        return token;
    }
    SendNext(now, out);
    return token;
}

void ClientSession::StopControl(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready)
    {
        return;
    }
    SettleInFlight(EControlOutcome::Unknown, "STOP control followed it", out);
    SettleWaiting("STOP control went before it", out);
    SendNow(StopRequest{EStopTarget::Control}, out);
    SendNext(now, out);
}

void ClientSession::OnConnected(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Connecting)
    {
        return;
    }
    out.emplace_back(ClientCancelTimer{EClientTimer::Connect});
    _state = EClientState::Handshaking;
    SendAwaited(HandshakeRequest{}, EInFlight::Handshake, now, out);
}

void ClientSession::OnConnectFailed(std::string_view detail, Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Connecting)
    {
        Lose(EClientLossReason::ConnectFailed, detail, now, out);
    }
}

void ClientSession::OnBytes(std::string_view bytes, Core::Now now, ClientActions& out)
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
        Lose(EClientLossReason::LineTooLong, "the controller sent a line beyond the limit", now, out);
    }
}

void ClientSession::ProcessLine(std::string_view text, Core::Now now, ClientActions& out)
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

void ClientSession::Handle(HandshakeAck& ack, Core::Now now, ClientActions& out)
{
    if (_inFlight != EInFlight::Handshake)
    {
        return;
    }
    if (!ack.bOk)
    {
        Lose(EClientLossReason::HandshakeFailed, "the controller did not accept the HANDSHAKE", now, out);
        return;
    }
    FinishInFlight(out);
    ++_stats.connects;
    _backoff.Reset();
    _state = EClientState::Ready;
    _bMonitorOn = false;
    _bMonitorStopFirst = false;
    _bMonitorDue = _monitor.has_value();
    Report(ClientReady{std::move(ack.version)}, out);
    SendNext(now, out);
}

void ClientSession::Handle(MonitorAck& /*ack*/, Core::Now now, ClientActions& out)
{
    if (_inFlight != EInFlight::Monitor)
    {
        return;
    }
    FinishInFlight(out);
    _bMonitorOn = true;
    _bStale = false;
    _lastTs.reset();
    _lastDataAt = now.steady;
    Report(ClientMonitorStarted{}, out);
    ArmDataAge(out);
    SendNext(now, out);
}

void ClientSession::Handle(DataLine& line, Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || !_monitor.has_value())
    {
        return; // still on its way when the stream was stopped
    }
    CountMissing(line);
    _lastDataAt = now.steady;
    _bStale = false;
    ArmDataAge(out);
    Report(ClientData{std::move(line), now}, out);
}

void ClientSession::CountMissing(const DataLine& line)
{
    ++_stats.dataLines;
    const double period = static_cast<double>(_monitor->period.count());
    const double steps = _lastTs.has_value() ? std::round((line.ts - *_lastTs) / period) : 1.0;
    // A step beyond a day's is no loss but another clock.
    constexpr double MOST = 50'000'000.0;
    if (steps > 1.0 && steps < MOST)
    {
        _stats.missingLines += static_cast<std::uint64_t>(steps) - 1;
    }
    _lastTs = line.ts;
}

void ClientSession::Handle(StopAck& ack, Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Ending && ack.target == EStopTarget::Session)
    {
        End(out);
        return;
    }
    if (_inFlight == EInFlight::StopMonitor && ack.target == EStopTarget::Monitor)
    {
        FinishInFlight(out);
        _bMonitorOn = false;
        _bMonitorStopFirst = false;
    }
    Report(ClientStopped{ack.target}, out);
    SendNext(now, out);
}

void ClientSession::Handle(ControlError& error, Core::Now now, ClientActions& out)
{
    RefuseControl(
        error.status,
        std::move(error.body),
        fmt::format("the controller refused the CONTROL with status {}", error.status),
        out);
    SendNext(now, out);
}

void ClientSession::Handle(ErrorLine& error, Core::Now now, ClientActions& out)
{
    switch (_state)
    {
        case EClientState::Handshaking:
            Lose(EClientLossReason::HandshakeFailed, Describe(error), now, out);
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

void ClientSession::HandleErrorWhenReady(ErrorLine& error, Core::Now now, ClientActions& out)
{
    const EErrorScope scope = GetErrorScope(error.code);
    const bool bOfRequest = scope == EErrorScope::Request;
    if (scope == EErrorScope::Fatal)
    {
        Lose(EClientLossReason::SessionEnded, Describe(error), now, out);
        return;
    }
    if (_inFlight == EInFlight::Monitor && (bOfRequest || scope == EErrorScope::Monitor))
    {
        HandleMonitorError(error, out);
    }
    else if (scope == EErrorScope::Stop || (bOfRequest && _inFlight == EInFlight::StopMonitor))
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

void ClientSession::HandleMonitorError(ErrorLine& error, ClientActions& out)
{
    FinishInFlight(out);
    if (error.code == EOpenStreamErrorCode::MonitorAlreadyActive && !std::exchange(_bMonitorStopFirst, true))
    {
        _bMonitorOn = true;
        _bMonitorDue = true;
        return;
    }
    _bMonitorStopFirst = false;
    Report(ClientMonitorRefused{std::move(error)}, out);
}

void ClientSession::HandleStopError(ErrorLine& error, ClientActions& out)
{
    const bool bOfMonitor = _inFlight == EInFlight::StopMonitor;
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

void ClientSession::RefuseControl(
    int status,
    std::optional<Core::JsonText> body,
    std::string detail,
    ClientActions& out)
{
    if (_inFlight != EInFlight::Control)
    {
        Report(ClientControlFault{status, std::move(body), std::move(detail)}, out);
        return;
    }
    FinishInFlight(out);
    Report(
        ClientControlSettled{_controlToken, EControlOutcome::Refused, status, std::move(body), std::move(detail)},
        out);
}

/// Ends the tracking of a CONTROL in flight, if there is one.
void ClientSession::SettleInFlight(EControlOutcome outcome, std::string_view detail, ClientActions& out)
{
    if (_inFlight == EInFlight::Control)
    {
        FinishInFlight(out);
        Report(ClientControlSettled{_controlToken, outcome, 0, std::nullopt, std::string(detail)}, out);
    }
}

void ClientSession::SettleWaiting(std::string_view detail, ClientActions& out)
{
    while (const std::optional<PendingControl> control = _controls.PopFrontOrNull())
    {
        Report(
            ClientControlSettled{control->token, EControlOutcome::NotSent, 0, std::nullopt, std::string(detail)},
            out);
    }
}

void ClientSession::FinishInFlight(ClientActions& out)
{
    _inFlight = EInFlight::Nothing;
    out.emplace_back(ClientCancelTimer{EClientTimer::Answer});
}

/// One awaited command at a time: the MONITOR's wish goes before the CONTROLs.
void ClientSession::SendNext(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || _inFlight != EInFlight::Nothing || TrySendMonitorWish(now, out))
    {
        return;
    }
    if (const std::optional<PendingControl> control = _controls.PopFrontOrNull())
    {
        _controlToken = control->token;
        _bControlLeft = false;
        _inFlight = EInFlight::Control;
        OpenStreamCodec::EncodeRequest(control->request, _outbox.GetLines());
        _controlMark = _outbox.GetMark();
        Flush(out);
    }
}

bool ClientSession::TrySendMonitorWish(Core::Now now, ClientActions& out)
{
    if (!_bMonitorDue)
    {
        return false;
    }
    if (_bMonitorOn && (!_monitor.has_value() || _bMonitorStopFirst))
    {
        _bMonitorDue = _monitor.has_value();
        SendAwaited(StopRequest{EStopTarget::Monitor}, EInFlight::StopMonitor, now, out);
        return true;
    }
    _bMonitorDue = false;
    if (_monitor.has_value())
    {
        SendAwaited(*_monitor, EInFlight::Monitor, now, out);
    }
    return _monitor.has_value();
}

void ClientSession::SendNow(const OpenStreamRequest& request, ClientActions& out)
{
    OpenStreamCodec::EncodeRequest(request, _outbox.GetLines());
    Flush(out);
}

void ClientSession::SendAwaited(const OpenStreamRequest& request, EInFlight kind, Core::Now now, ClientActions& out)
{
    _inFlight = kind;
    out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.answerTimeout});
    SendNow(request, out);
}

void ClientSession::Flush(ClientActions& out)
{
    if (const std::string_view text = _outbox.TakeForSend(); !text.empty())
    {
        out.emplace_back(ClientSend{text});
    }
}

void ClientSession::OnSendCompleted(Core::Now now, ClientActions& out)
{
    if (!IsConnected() || !_outbox.IsSending())
    {
        return;
    }
    static_cast<void>(_outbox.CompleteSend());
    if (_inFlight == EInFlight::Control && !_bControlLeft && _outbox.WasSent(_controlMark))
    {
        _bControlLeft = true;
        out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.controlWindow});
    }
    Flush(out);
}

void ClientSession::OnPeerClosed(Core::Now now, ClientActions& out)
{
    Disconnect(EClientLossReason::PeerClosed, "the controller closed the connection", now, out);
}

void ClientSession::OnSocketError(std::string_view detail, Core::Now now, ClientActions& out)
{
    Disconnect(EClientLossReason::SocketError, detail, now, out);
}

void ClientSession::Disconnect(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out)
{
    if (_state == EClientState::Ending)
    {
        End(out);
    }
    else if (IsConnected())
    {
        Lose(reason, detail, now, out);
    }
}

void ClientSession::OnTimer(EClientTimer timer, Core::Now now, ClientActions& out)
{
    switch (timer)
    {
        case EClientTimer::Connect:
            if (_state == EClientState::Connecting)
            {
                Lose(EClientLossReason::ConnectTimeout, "the connection was not made in time", now, out);
            }
            break;
        case EClientTimer::Answer:
            OnAnswerTimeout(now, out);
            break;
        case EClientTimer::DataAge:
            _bDataAgeArmed = false;
            CheckDataAge(now, out);
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

void ClientSession::OnAnswerTimeout(Core::Now now, ClientActions& out)
{
    switch (_inFlight)
    {
        case EInFlight::Nothing:
            break;
        case EInFlight::Control:
            SettleInFlight(EControlOutcome::Accepted, {}, out);
            SendNext(now, out);
            break;
        case EInFlight::StopSession:
            End(out);
            break;
        case EInFlight::Handshake:
        case EInFlight::Monitor:
        case EInFlight::StopMonitor:
            Lose(EClientLossReason::AnswerTimeout, "the controller did not answer in time", now, out);
            break;
        default:
            assert(false && "unhandled EInFlight");
            break;
    }
}

std::chrono::milliseconds ClientSession::GetDataLimit() const noexcept
{
    const bool bWaitsForStale = !_bStale && _options.staleAfter.count() > 0;
    return bWaitsForStale ? _options.staleAfter : _options.lostAfter;
}

/// Started forward only, and again where it fires early: see the watchdog of ServerSession.
void ClientSession::ArmDataAge(ClientActions& out)
{
    const std::chrono::milliseconds limit = GetDataLimit();
    if (!_bMonitorOn || !_monitor.has_value() || limit.count() <= 0)
    {
        return;
    }
    const Core::SteadyTime deadline = _lastDataAt + _monitor->period + limit;
    if (!_bDataAgeArmed || deadline < _dataAgeAt)
    {
        _bDataAgeArmed = true;
        _dataAgeAt = deadline;
        out.emplace_back(ClientStartTimer{EClientTimer::DataAge, deadline});
    }
}

void ClientSession::CheckDataAge(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || !_bMonitorOn || !_monitor.has_value())
    {
        return;
    }
    const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(now.steady - _lastDataAt);
    const std::chrono::milliseconds overdue = age - _monitor->period;
    if (!_bStale && _options.staleAfter.count() > 0 && overdue >= _options.staleAfter)
    {
        _bStale = true;
        Report(ClientMonitorStale{age}, out);
    }
    if (_options.lostAfter.count() > 0 && overdue >= _options.lostAfter)
    {
        Lose(EClientLossReason::DataSilent, "the controller sent no data", now, out);
        return;
    }
    ArmDataAge(out);
}

bool ClientSession::IsConnected() const noexcept
{
    return _state == EClientState::Handshaking || _state == EClientState::Ready || _state == EClientState::Ending;
}

void ClientSession::Lose(EClientLossReason reason, std::string_view detail, Core::Now now, ClientActions& out)
{
    // The detail may stand in the buffers that the next connection uses.
    std::string reasonText(detail);
    DropConnection(detail, out);
    _state = EClientState::Waiting;
    const std::chrono::milliseconds delay = _backoff.GetNextDelay(_random);
    out.emplace_back(ClientStartTimer{EClientTimer::Retry, now.steady + delay});
    Report(ClientLost{reason, std::move(reasonText), delay}, out);
}

void ClientSession::DropConnection(std::string_view detail, ClientActions& out)
{
    const bool bLeft = _outbox.WasTaken(_controlMark);
    SettleInFlight(bLeft ? EControlOutcome::Unknown : EControlOutcome::NotSent, detail, out);
    SettleWaiting(detail, out);
    _inFlight = EInFlight::Nothing;
    _bMonitorOn = false;
    _bStale = false;
    _bDataAgeArmed = false;
    for (const EClientTimer timer :
         {EClientTimer::Connect, EClientTimer::Answer, EClientTimer::DataAge, EClientTimer::Retry})
    {
        out.emplace_back(ClientCancelTimer{timer});
    }
    out.emplace_back(ClientClose{});
}

void ClientSession::End(ClientActions& out)
{
    DropConnection("the session was stopped", out);
    _state = EClientState::Stopped;
    Report(ClientEnded{}, out);
}

EClientState ClientSession::GetState() const noexcept
{
    return _state;
}

const ClientSessionStats& ClientSession::GetStats() const noexcept
{
    return _stats;
}

} // namespace ACS::OpenStream

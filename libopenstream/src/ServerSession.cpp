#include <acs/core/Overloaded.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <ratio>

namespace ACS::OpenStream
{

namespace
{

constexpr std::string_view VERSION = "1.0.0";
constexpr int FIRST_SERVICE_FAILURE = 500;

enum class EVerdict : std::uint8_t
{
    Run,
    HandshakeRequired,
    Busy,
};

/// What each state says to each command, before its payload is looked at.
struct GateRow
{
    EServerState state;
    std::array<EVerdict, std::variant_size_v<OpenStreamRequest>> verdicts; ///< Handshake, Monitor, Control, Stop.
};

constexpr EVerdict RUN = EVerdict::Run;
constexpr EVerdict SHAKE = EVerdict::HandshakeRequired;
constexpr EVerdict BUSY = EVerdict::Busy;

constexpr std::array GATE{
    GateRow{EServerState::Connected, {RUN, SHAKE, SHAKE, SHAKE}},
    GateRow{EServerState::Ready, {RUN, RUN, RUN, RUN}},
    GateRow{EServerState::Streaming, {BUSY, RUN, RUN, RUN}},
    GateRow{EServerState::Closing, {SHAKE, SHAKE, SHAKE, SHAKE}},
    GateRow{EServerState::Closed, {SHAKE, SHAKE, SHAKE, SHAKE}},
};

std::string_view GetRefusalMessage(EOpenStreamErrorCode code)
{
    return code == EOpenStreamErrorCode::BusySessionActive
        ? "a MONITOR is active or a CONTROL is being worked on: STOP it before another HANDSHAKE"
        : "send HANDSHAKE first";
}

void FillRequest(
    EApiMethod method,
    std::string_view url,
    const std::optional<Core::JsonText>& args,
    ApiRequest& request)
{
    request.method = method;
    SplitUrl(url, request);
    if (args.has_value())
    {
        AddArguments(*args, request);
    }
}

} // namespace

ServerSessionStats& ServerSessionStats::operator+=(const ServerSessionStats& other) noexcept
{
    dataLines += other.dataLines;
    replacedLines += other.replacedLines;
    skippedTicks += other.skippedTicks;
    commands += other.commands;
    errorLines += other.errorLines;
    controlErrors += other.controlErrors;
    return *this;
}

ServerSession::ServerSession(const ServerSessionOptions& options)
    : _options(options),
      _framer(options.longestLine),
      _outbox(options.maximumOutput),
      _controls(options.maximumControls)
{
}

void ServerSession::Start(Core::Now now, ServerActions& out)
{
    _lastCommandAt = now.steady;
    ArmWatchdog(out);
}

void ServerSession::Reject(std::string_view message, Core::Now now, ServerActions& out)
{
    AppendError(EOpenStreamErrorCode::HandshakeRejected, message);
    BeginClosing(EServerCloseReason::Rejected, now, out);
    Flush(out);
}

void ServerSession::OnBytes(std::string_view bytes, Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    _framer.Feed(bytes);
    ProcessLines(now, out);
}

void ServerSession::OnContinue(Core::Now now, ServerActions& out)
{
    _bContinuing = false;
    ProcessLines(now, out);
}

/// Takes whole lines as long as there is room for what they ask and their turn lasts.
void ServerSession::ProcessLines(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    std::size_t count = 0;
    bool bDrained = false;
    while (!_bContinuing)
    {
        const bool bBlocked = _controls.IsFull() && !_bRefusingControls;
        if (bBlocked || count == _options.commandsPerTurn)
        {
            break;
        }
        const std::optional<std::string_view> line = _framer.TakeLineOrNull();
        if (!line.has_value())
        {
            bDrained = true;
            break;
        }
        ++count;
        ProcessLine(*line, now, out);
    }
    _framer.Keep();
    if (_framer.HasOverflown() && _state < EServerState::Closing)
    {
        AppendError(EOpenStreamErrorCode::RxBufOverflow, "the line is longer than this server reads");
        BeginClosing(EServerCloseReason::LineTooLong, now, out);
    }
    if (!bDrained && !_bReadingPaused)
    {
        _bReadingPaused = true;
        out.emplace_back(ServerPauseReading{});
    }
    else if (bDrained && _bReadingPaused)
    {
        _bReadingPaused = false;
        out.emplace_back(ServerResumeReading{});
    }
    if (_controls.IsFull() && !_bRefusingControls)
    {
        out.emplace_back(ServerStartTimer{EServerTimer::ControlBusy, now.steady + _options.controlBusyAfter});
    }
    else if (!bDrained && !_bContinuing)
    {
        _bContinuing = true;
        out.emplace_back(ServerContinue{});
    }
    Flush(out);
}

void ServerSession::ProcessLine(std::string_view line, Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closing && _closeReason != EServerCloseReason::StopSession)
    {
        return;
    }
    const Core::Result<EOpenStreamCommand> command = _codec.ReadCommand(line);
    if (!command.has_value())
    {
        AppendError(static_cast<EOpenStreamErrorCode>(command.error().code.value()), Core::Describe(command.error()));
        return;
    }
    if (const std::optional<EOpenStreamErrorCode> refusal = GetGateErrorOrNull(*command))
    {
        AppendError(*refusal, GetRefusalMessage(*refusal));
        return;
    }
    const Core::Result<OpenStreamRequest> request = _codec.ReadRequest();
    if (!request.has_value())
    {
        AppendError(static_cast<EOpenStreamErrorCode>(request.error().code.value()), Core::Describe(request.error()));
        return;
    }
    ++_stats.commands;
    _lastCommandAt = now.steady;
    std::visit([this, now, &out](const auto& payload) { Handle(payload, now, out); }, *request);
}

std::optional<EOpenStreamErrorCode> ServerSession::GetGateErrorOrNull(EOpenStreamCommand command) const
{
    const auto* const row = std::ranges::find(GATE, _state, &GateRow::state);
    assert(row != GATE.end());
    const EVerdict verdict = row->verdicts.at(static_cast<std::size_t>(command));
    const bool bControlBusy = command == EOpenStreamCommand::Handshake && !_controls.IsEmpty();
    if (verdict == EVerdict::HandshakeRequired)
    {
        return EOpenStreamErrorCode::HandshakeRequired;
    }
    return verdict == EVerdict::Busy || bControlBusy ? std::optional(EOpenStreamErrorCode::BusySessionActive)
                                                     : std::nullopt;
}

void ServerSession::Handle(const HandshakeRequest& request, Core::Now /*now*/, ServerActions& /*out*/)
{
    if (request.major != PROTOCOL_MAJOR)
    {
        AppendError(EOpenStreamErrorCode::VersionMismatch, "this server speaks major version 1");
        return;
    }
    _state = EServerState::Ready;
    _bControlled = false;
    OpenStreamCodec::EncodeLine(HandshakeAck{true, std::string(VERSION)}, _outbox.GetLines());
}

void ServerSession::Handle(const MonitorRequest& request, Core::Now now, ServerActions& out)
{
    // No line of the old recipe may come behind this ack.
    _outbox.SealData();
    OpenStreamCodec::EncodeLine(MonitorAck{}, _outbox.GetLines());
    FillRequest(EApiMethod::Get, request.url, request.args, _monitorCall);
    _monitorID = request.id;
    _period = request.period;
    _monitorToken = 0;
    _bMonitorFailing = false;
    const Core::SteadyTime firstTick = now.steady + _period;
    if (_state == EServerState::Streaming)
    {
        // The earlier tick stays: a client that sends MONITOR at every period would otherwise starve the stream.
        _nextTick = std::min(_nextTick, firstTick);
    }
    else
    {
        _state = EServerState::Streaming;
        _monitorBegin = now.steady;
        _lastDataAt = now.steady;
        _nextTick = firstTick;
    }
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
    ArmWatchdog(out);
}

void ServerSession::Handle(const ControlRequest& request, Core::Now /*now*/, ServerActions& out)
{
    ApiRequest call;
    FillRequest(request.method, request.url, request.args, call);
    call.body = request.body.value_or(Core::JsonText::FromTrusted("{}"));
    if (!_controls.TryPush(std::move(call)))
    {
        AppendError(EOpenStreamErrorCode::ControlBusy, "too many CONTROLs wait for the controller");
        return;
    }
    _bControlled = true;
    CallNextControl(out);
}

void ServerSession::Handle(const StopRequest& request, Core::Now now, ServerActions& out)
{
    bool bThere = true;
    switch (request.target)
    {
        case EStopTarget::Monitor:
            bThere = _state == EServerState::Streaming;
            StopMonitor(out);
            break;
        case EStopTarget::Control:
            bThere = TryStopControl(out);
            break;
        case EStopTarget::Session:
            StopMonitor(out);
            OpenStreamCodec::EncodeLine(StopAck{request.target}, _outbox.GetLines());
            BeginClosing(EServerCloseReason::StopSession, now, out);
            return;
        default:
            assert(false && "unhandled EStopTarget");
            return;
    }
    if (!bThere)
    {
        AppendError(EOpenStreamErrorCode::NothingToStop, "there is nothing to stop");
        return;
    }
    OpenStreamCodec::EncodeLine(StopAck{request.target}, _outbox.GetLines());
    ArmWatchdog(out);
}

void ServerSession::StopMonitor(ServerActions& out)
{
    if (_state != EServerState::Streaming)
    {
        return;
    }
    _outbox.SealData();
    _state = EServerState::Ready;
    _monitorToken = 0;
    out.emplace_back(ServerCancelTimer{EServerTimer::MonitorTick});
}

bool ServerSession::TryStopControl(ServerActions& out)
{
    if (!_bControlled)
    {
        return false;
    }
    _bControlled = false;
    // What waits is not executed any more; the one in flight cannot be taken back and keeps its place.
    bool bFirst = true;
    _controls.EraseIf([&bFirst](const ApiRequest&) { return !std::exchange(bFirst, false); });
    _bRefusingControls = _bRefusingControls && _controls.IsFull();
    out.emplace_back(ServerStopControl{});
    return true;
}

void ServerSession::CallNextControl(ServerActions& out)
{
    const ApiRequest* next = _controls.GetFrontOrNull();
    if (_controlToken == 0 && next != nullptr)
    {
        _controlToken = ++_lastToken;
        out.emplace_back(ServerCall{_controlToken, next});
    }
}

void ServerSession::OnServiceAnswer(std::uint64_t token, const ApiResponse& response, Core::Now now, ServerActions& out)
{
    if (token == 0 || _state == EServerState::Closed)
    {
        return;
    }
    if (token == _controlToken)
    {
        FinishControl(response, now, out);
    }
    else if (token == _monitorToken)
    {
        FinishMonitor(response, now, out);
    }
    Flush(out);
}

void ServerSession::FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out)
{
    if (!response.IsSuccess())
    {
        ++_stats.controlErrors;
        OpenStreamCodec::EncodeLine(ControlError{response.status, response.body}, _outbox.GetLines());
    }
    const bool bWasFull = _controls.IsFull();
    static_cast<void>(_controls.PopFrontOrNull());
    _controlToken = 0;
    CallNextControl(out);
    if (bWasFull)
    {
        _bRefusingControls = false;
        out.emplace_back(ServerCancelTimer{EServerTimer::ControlBusy});
        ProcessLines(now, out);
    }
}

void ServerSession::FinishMonitor(const ApiResponse& response, Core::Now now, ServerActions& /*out*/)
{
    using Milliseconds = std::chrono::duration<double, std::milli>;
    _monitorToken = 0;
    if (response.bNoSample)
    {
        ++_stats.skippedTicks;
        return;
    }
    if (response.status >= FIRST_SERVICE_FAILURE)
    {
        ReportMonitorFailure();
    }
    else
    {
        _bMonitorFailing = false;
    }
    bool bReplaced = false;
    std::string& data = _outbox.BeginData(bReplaced);
    _stats.replacedLines += bReplaced ? 1U : 0U;
    const auto ts = std::chrono::duration_cast<std::chrono::milliseconds>(_monitorAskedAt - _monitorBegin);
    const Milliseconds duration = std::max(now.steady - _monitorAskedAt, Core::Duration::zero());
    OpenStreamCodec::EncodeData(ts.count(), duration.count(), response, _monitorID, data);
}

void ServerSession::ReportMonitorFailure()
{
    if (!_bMonitorFailing)
    {
        _bMonitorFailing = true;
        AppendError(EOpenStreamErrorCode::MonitorInternalError, "the controller's service failed");
    }
}

void ServerSession::OnTimer(EServerTimer timer, Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    switch (timer)
    {
        case EServerTimer::MonitorTick:
            Tick(now, out);
            break;
        case EServerTimer::Watchdog:
            CheckWatchdog(now, out);
            break;
        case EServerTimer::ControlBusy:
            _bRefusingControls = _controls.IsFull();
            ProcessLines(now, out);
            break;
        case EServerTimer::Close:
            if (_state == EServerState::Closing)
            {
                Close(out);
            }
            break;
        default:
            assert(false && "unhandled EServerTimer");
            break;
    }
    Flush(out);
}

void ServerSession::Tick(Core::Now now, ServerActions& out)
{
    if (_state != EServerState::Streaming)
    {
        return;
    }
    if (now.steady < _nextTick)
    {
        out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
        return;
    }
    // The phase stays: a late tick moves none of those behind it, and those that it has missed are not made up for.
    const auto missed = (now.steady - _nextTick) / std::chrono::duration_cast<Core::Duration>(_period);
    _stats.skippedTicks += static_cast<std::uint64_t>(missed);
    _nextTick += _period * (missed + 1);
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
    if (_monitorToken != 0)
    {
        ++_stats.skippedTicks;
        if (now.steady - _monitorAskedAt >= _options.serviceTimeout)
        {
            ReportMonitorFailure();
        }
        return;
    }
    _monitorToken = ++_lastToken;
    _monitorAskedAt = now.steady;
    out.emplace_back(ServerCall{_monitorToken, &_monitorCall});
}

Core::SteadyTime ServerSession::GetWatchdogDeadline() const
{
    // While streaming, silence counts from when the next line was due: the longest period is longer than the limit.
    return _state == EServerState::Streaming ? _lastDataAt + _period + _options.streamingTimeout
                                             : _lastCommandAt + _options.idleTimeout;
}

/// The timer is only moved forward. Where the deadline has moved back when it fires, it is started again: so feeding the
/// watchdog costs nothing at each line.
void ServerSession::ArmWatchdog(ServerActions& out)
{
    const Core::SteadyTime deadline = GetWatchdogDeadline();
    if (_state >= EServerState::Closing || (_bWatchdogArmed && _watchdogAt <= deadline))
    {
        return;
    }
    _bWatchdogArmed = true;
    _watchdogAt = deadline;
    out.emplace_back(ServerStartTimer{EServerTimer::Watchdog, deadline});
}

void ServerSession::CheckWatchdog(Core::Now now, ServerActions& out)
{
    if (_state >= EServerState::Closing)
    {
        return;
    }
    _bWatchdogArmed = false;
    if (now.steady < GetWatchdogDeadline())
    {
        ArmWatchdog(out);
        return;
    }
    const bool bStreaming = _state == EServerState::Streaming;
    StopMonitor(out);
    AppendError(
        EOpenStreamErrorCode::SessionTimeout,
        bStreaming ? "the stream was interrupted for too long" : "no command came for too long");
    BeginClosing(bStreaming ? EServerCloseReason::StreamingTimeout : EServerCloseReason::IdleTimeout, now, out);
}

void ServerSession::OnSendCompleted(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    const std::size_t dataLines = _outbox.CompleteSend();
    _stats.dataLines += dataLines;
    if (dataLines > 0)
    {
        _lastDataAt = now.steady;
    }
    Flush(out);
}

void ServerSession::OnPeerClosed(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    _bPeerClosed = true;
    if (_state != EServerState::Closing)
    {
        StopMonitor(out);
        BeginClosing(EServerCloseReason::PeerClosed, now, out);
    }
    Flush(out);
}

void ServerSession::OnSocketError(ServerActions& out)
{
    if (_state != EServerState::Closed)
    {
        _closeReason = EServerCloseReason::SocketError;
        Close(out);
    }
}

void ServerSession::AppendError(EOpenStreamErrorCode code, std::string_view message)
{
    ++_stats.errorLines;
    OpenStreamCodec::EncodeLine(ErrorLine{code, {}, std::string(message), {}}, _outbox.GetLines());
}

void ServerSession::BeginClosing(EServerCloseReason reason, Core::Now now, ServerActions& out)
{
    StopMonitor(out);
    _state = EServerState::Closing;
    _closeReason = reason;
    _bWatchdogArmed = false;
    out.emplace_back(ServerCancelTimer{EServerTimer::Watchdog});
    out.emplace_back(ServerStartTimer{EServerTimer::Close, now.steady + _options.closeTimeout});
}

void ServerSession::Close(ServerActions& out)
{
    _state = EServerState::Closed;
    _monitorToken = 0;
    _controlToken = 0;
    for (const EServerTimer timer :
         {EServerTimer::MonitorTick, EServerTimer::Watchdog, EServerTimer::ControlBusy, EServerTimer::Close})
    {
        out.emplace_back(ServerCancelTimer{timer});
    }
    out.emplace_back(ServerClose{_closeReason});
}

/// Sends what waits; in the end shuts down and closes.
void ServerSession::Flush(ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    if (_outbox.IsFull())
    {
        _closeReason = EServerCloseReason::OutputFull;
        Close(out);
        return;
    }
    if (_bSendShutDown)
    {
        if (_bPeerClosed)
        {
            Close(out);
        }
        return;
    }
    if (const std::string_view text = _outbox.TakeForSend(); !text.empty())
    {
        out.emplace_back(ServerSend{text});
        return;
    }
    if (_state == EServerState::Closing && !_outbox.IsSending() && _controls.IsEmpty())
    {
        _bSendShutDown = true;
        out.emplace_back(ServerShutdownSend{});
        if (_bPeerClosed)
        {
            Close(out);
        }
    }
}

EServerState ServerSession::GetState() const noexcept
{
    return _state;
}

const ServerSessionStats& ServerSession::GetStats() const noexcept
{
    return _stats;
}

} // namespace ACS::OpenStream

#include "ServerSession.Impl.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

constexpr std::string_view VERSION = "1.0.0";

enum class EVerdict : std::uint8_t
{
    Run,
    HandshakeRequired,
    Busy,
};

/// The verdict of each state on each command, before its payload is checked.
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

ServerSession::Impl::Impl(const ServerSessionOptions& options)
    : _options(options),
      _framer(options.longestLine),
      _outbox(options.maximumOutput),
      _controls(options.maximumControls)
{
}

void ServerSession::Impl::Start(Core::Now now, ServerActions& out)
{
    _connectedAt = now.steady;
    _lastCommandAt = now.steady;
    ArmWatchdog(out);
}

void ServerSession::Impl::Reject(std::string_view message, Core::Now now, ServerActions& out)
{
    AppendError(EOpenStreamErrorCode::HandshakeRejected, message);
    BeginClosing(EServerCloseReason::Rejected, now, out);
    Flush(out);
}

void ServerSession::Impl::OnBytes(std::string_view bytes, Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    _framer.Feed(bytes);
    ProcessLines(now, out);
}

void ServerSession::Impl::OnContinue(Core::Now now, ServerActions& out)
{
    _bContinuing = false;
    ProcessLines(now, out);
}

/// Processes lines while there is room for their commands and their turn lasts.
void ServerSession::Impl::ProcessLines(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    std::size_t count = 0;
    bool bDrained = false;
    while (!_bContinuing)
    {
        const bool bBlocked = !HasRoomForControls() && !_bRefusingControls;
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
    if (!HasRoomForControls() && !_bRefusingControls)
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

void ServerSession::Impl::ProcessLine(std::string_view line, Core::Now now, ServerActions& out)
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

std::optional<EOpenStreamErrorCode> ServerSession::Impl::GetGateErrorOrNull(EOpenStreamCommand command) const
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

void ServerSession::Impl::Handle(const HandshakeRequest& request, Core::Now /*now*/, ServerActions& /*out*/)
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

void ServerSession::Impl::FillRequest(
    EApiMethod method,
    std::string_view url,
    const std::optional<Core::JsonText>& argsOrNull,
    ApiRequest& request)
{
    request.method = method;
    SplitURL(url, request);
    if (argsOrNull.has_value())
    {
        AddArguments(*argsOrNull, request);
    }
}

void ServerSession::Impl::Handle(const StopRequest& request, Core::Now now, ServerActions& out)
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

void ServerSession::Impl::OnServiceAnswer(
    std::uint64_t token,
    const ApiResponse& response,
    Core::Now now,
    ServerActions& out)
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

void ServerSession::Impl::OnTimer(EServerTimer timer, Core::Now now, ServerActions& out)
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
            _bRefusingControls = !HasRoomForControls();
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

bool ServerSession::Impl::IsHandshakeDue() const noexcept
{
    return _state == EServerState::Connected && _options.handshakeTimeout > std::chrono::milliseconds::zero();
}

Core::SteadyTime ServerSession::Impl::GetWatchdogDeadline() const
{
    if (IsHandshakeDue())
    {
        return _connectedAt + _options.handshakeTimeout;
    }
    // While streaming, silence counts from when the next line was due: the longest period is longer than the limit.
    return _state == EServerState::Streaming ? _lastDataAt + _period + _options.streamingTimeout
                                             : _lastCommandAt + _options.idleTimeout;
}

/// The timer is only moved forward. Where the deadline has moved back when it fires, it is started again: so feeding the
/// watchdog costs nothing at each line.
void ServerSession::Impl::ArmWatchdog(ServerActions& out)
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

void ServerSession::Impl::CheckWatchdog(Core::Now now, ServerActions& out)
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
    EndForTimeout(now, out);
}

void ServerSession::Impl::EndForTimeout(Core::Now now, ServerActions& out)
{
    EServerCloseReason reason = EServerCloseReason::IdleTimeout;
    std::string_view message = "no command came for too long";
    if (_state == EServerState::Streaming)
    {
        reason = EServerCloseReason::StreamingTimeout;
        message = "the stream was interrupted for too long";
    }
    else if (IsHandshakeDue())
    {
        reason = EServerCloseReason::HandshakeTimeout;
        message = "no HANDSHAKE came in time";
    }
    StopMonitor(out);
    AppendError(EOpenStreamErrorCode::SessionTimeout, message);
    BeginClosing(reason, now, out);
}

void ServerSession::Impl::OnSendCompleted(Core::Now now, ServerActions& out)
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

void ServerSession::Impl::OnPeerClosed(Core::Now now, ServerActions& out)
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

void ServerSession::Impl::OnSocketError(ServerActions& out)
{
    if (_state != EServerState::Closed)
    {
        _closeReason = EServerCloseReason::SocketError;
        Close(out);
    }
}

void ServerSession::Impl::AppendError(EOpenStreamErrorCode code, std::string_view message)
{
    ++_stats.errorLines;
    OpenStreamCodec::EncodeLine(ErrorLine{code, {}, std::string(message), {}}, _outbox.GetLines());
}

void ServerSession::Impl::BeginClosing(EServerCloseReason reason, Core::Now now, ServerActions& out)
{
    StopMonitor(out);
    _state = EServerState::Closing;
    _closeReason = reason;
    _bWatchdogArmed = false;
    out.emplace_back(ServerCancelTimer{EServerTimer::Watchdog});
    out.emplace_back(ServerStartTimer{EServerTimer::Close, now.steady + _options.closeTimeout});
}

void ServerSession::Impl::Close(ServerActions& out)
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
void ServerSession::Impl::Flush(ServerActions& out)
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

EServerState ServerSession::Impl::GetState() const noexcept
{
    return _state;
}

const ServerSessionStats& ServerSession::Impl::GetStats() const noexcept
{
    return _stats;
}

} // namespace ACS::OpenStream

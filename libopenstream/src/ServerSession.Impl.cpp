#include "ServerSession.Impl.hpp"

#include <cassert>
#include <string>
#include <utility>

namespace ACS::OpenStream
{

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
      _monitor(options.serviceTimeout),
      _controls(options)
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
    _reading = _reading == EReading::Continuing ? EReading::Blocked : _reading;
    ProcessLines(now, out);
}

void ServerSession::Impl::ProcessLines(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Closed)
    {
        return;
    }
    const bool bDrained = _reading != EReading::Continuing && TryDrainInput(now, out);
    _framer.Keep();
    if (_framer.HasOverflown() && _state < EServerState::Closing)
    {
        AppendError(EOpenStreamErrorCode::RxBufOverflow, "the line is longer than this server reads");
        BeginClosing(EServerCloseReason::LineTooLong, now, out);
    }
    if (!bDrained && _reading == EReading::Open)
    {
        out.emplace_back(ServerPauseReading{});
    }
    if (bDrained)
    {
        if (std::exchange(_reading, EReading::Open) != EReading::Open)
        {
            out.emplace_back(ServerResumeReading{});
        }
    }
    else if (_controls.IsBlocking())
    {
        _reading = EReading::Blocked;
        out.emplace_back(ServerStartTimer{EServerTimer::ControlBusy, now.steady + _options.controlBusyAfter});
    }
    else if (std::exchange(_reading, EReading::Continuing) != EReading::Continuing)
    {
        out.emplace_back(ServerContinue{});
    }
    Flush(out);
}

/// Processes lines while there is room for their commands and their turn lasts. False: more may be there.
bool ServerSession::Impl::TryDrainInput(Core::Now now, ServerActions& out)
{
    for (std::size_t count = 0; count < _options.commandsPerTurn && !_controls.IsBlocking(); ++count)
    {
        const std::optional<std::string_view> line = _framer.TakeLineOrNull();
        if (!line.has_value())
        {
            return true;
        }
        ProcessLine(*line, now, out);
    }
    return false;
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
    if (_controls.IsCall(token))
    {
        FinishControl(response, now, out);
    }
    else if (_monitor.IsCall(token))
    {
        FinishMonitor(response, now);
    }
    Flush(out);
}

void ServerSession::Impl::FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out)
{
    if (!response.IsSuccess())
    {
        ++_stats.controlErrors;
        OpenStreamCodec::EncodeLine(ControlError{response.status, response.body}, _outbox.GetLines());
    }
    const bool bResume = _controls.ShouldResumeAfterAnswer();
    _controls.CallNext(++_lastToken, out);
    if (bResume)
    {
        out.emplace_back(ServerCancelTimer{EServerTimer::ControlBusy});
        ProcessLines(now, out);
    }
}

void ServerSession::Impl::FinishMonitor(const ApiResponse& response, Core::Now now)
{
    Apply(_monitor.OnAnswer(response));
    if (!response.bNoSample)
    {
        bool bReplaced = false;
        std::string& data = _outbox.BeginData(bReplaced);
        _stats.replacedLines += bReplaced ? 1U : 0U;
        _monitor.Encode(response, now, data);
    }
}

void ServerSession::Impl::Tick(Core::Now now, ServerActions& out)
{
    if (_state == EServerState::Streaming)
    {
        Apply(_monitor.OnTick(++_lastToken, now, out));
    }
}

void ServerSession::Impl::Apply(const ServerMonitor::Outcome& outcome)
{
    _stats.skippedTicks += outcome.skipped;
    if (outcome.bFailureBegan)
    {
        AppendError(EOpenStreamErrorCode::MonitorInternalError, "the controller's service failed");
    }
}

void ServerSession::Impl::StopMonitor(ServerActions& out)
{
    if (_state == EServerState::Streaming)
    {
        _outbox.SealData();
        _state = EServerState::Ready;
        _monitor.Stop(out);
    }
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
            _controls.BeginRefusing();
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
    return _state == EServerState::Streaming ? _monitor.GetDataDue() + _options.streamingTimeout
                                             : _lastCommandAt + _options.idleTimeout;
}

void ServerSession::Impl::ArmWatchdog(ServerActions& out)
{
    const Core::SteadyTime deadline = GetWatchdogDeadline();
    if (_state < EServerState::Closing && _watchdog.ShouldStart(deadline))
    {
        out.emplace_back(ServerStartTimer{EServerTimer::Watchdog, deadline});
    }
}

void ServerSession::Impl::CheckWatchdog(Core::Now now, ServerActions& out)
{
    if (_state >= EServerState::Closing)
    {
        return;
    }
    _watchdog.Reset();
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
        _monitor.OnDataSent(now);
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
    _watchdog.Reset();
    out.emplace_back(ServerCancelTimer{EServerTimer::Watchdog});
    out.emplace_back(ServerStartTimer{EServerTimer::Close, now.steady + _options.closeTimeout});
}

void ServerSession::Impl::Close(ServerActions& out)
{
    _state = EServerState::Closed;
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

bool ServerSession::Impl::HasControl() const noexcept
{
    return _state < EServerState::Closing && _controls.HasReceived();
}

const ServerSessionStats& ServerSession::Impl::GetStats() const noexcept
{
    return _stats;
}

} // namespace ACS::OpenStream

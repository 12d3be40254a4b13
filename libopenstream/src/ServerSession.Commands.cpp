#include "ServerSession.Impl.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

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
    _controls.OnHandshake();
    OpenStreamCodec::EncodeLine(HandshakeAck{true, std::string(VERSION)}, _outbox.GetLines());
}

void ServerSession::Impl::Handle(const MonitorRequest& request, Core::Now now, ServerActions& out)
{
    // No line of the old recipe may come behind this ack.
    _outbox.SealData();
    OpenStreamCodec::EncodeLine(MonitorAck{}, _outbox.GetLines());
    if (_state == EServerState::Streaming)
    {
        _monitor.Replace(request, now, out);
    }
    else
    {
        _state = EServerState::Streaming;
        _monitor.Begin(request, now, out);
    }
    ArmWatchdog(out);
}

void ServerSession::Impl::Handle(const ControlRequest& request, Core::Now /*now*/, ServerActions& out)
{
    if (!_controls.TryAdd(request))
    {
        AppendError(EOpenStreamErrorCode::ControlBusy, "too many CONTROLs wait for the controller");
        return;
    }
    _controls.CallNext(++_lastToken, out);
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
            bThere = _controls.TryStop(out);
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

} // namespace ACS::OpenStream

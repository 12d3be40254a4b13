#include "ClientEvents.hpp"
#include "ClientSession.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::OpenStream
{

using Detail::Report;

void ClientSession::Impl::SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out)
{
    _monitor.Set(std::move(monitorOrNull));
    SendNext(now, out);
}

std::uint64_t ClientSession::Impl::SendControl(
    const ControlRequest& request,
    EControlTracking tracking,
    Core::Now now,
    ClientActions& out)
{
    if (tracking == EControlTracking::Streamed && _state == EClientState::Ready && !_output.IsFull())
    {
        SendUntil(request, GetControlDeadline({}, now), out); // without a copy
        return ++_lastToken;
    }
    ControlCall call;
    call.request = request;
    call.tracking = tracking;
    return SendControlCall(std::move(call), now, out);
}

std::uint64_t ClientSession::Impl::SendControlCall(ControlCall call, Core::Now now, ClientActions& out)
{
    const std::uint64_t token = ++_lastToken;
    const bool bReady = _state == EClientState::Ready && !_output.IsFull();
    const std::string_view obstacle = bReady ? "too many CONTROLs wait"
        : _state == EClientState::Ready      ? "the connection takes no more data"
                                             : "there is no session with the controller";
    const Core::SteadyTime deadline = GetControlDeadline(call.timeout, now);
    if (call.tracking == EControlTracking::Streamed)
    {
        if (bReady)
        {
            SendUntil(call.request, deadline, out);
        }
        else
        {
            Report(ClientControlFault{0, std::nullopt, fmt::format("not sent: {}", obstacle)}, out);
        }
        return token;
    }
    if (!bReady || !_controls.TryAdd(token, deadline, std::move(call)))
    {
        Report(ClientControlSettled{token, EControlOutcome::NotSent, 0, std::nullopt, std::string(obstacle)}, out);
        return token;
    }
    SendNext(now, out);
    ArmControlTimer(out);
    return token;
}

void ClientSession::Impl::StopControl(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready)
    {
        return;
    }
    constexpr std::string_view BEFORE = "STOP control went before it";
    const bool bTaken = _output.WasCommandTaken();
    if (bTaken)
    {
        _controls.AbandonCurrent("STOP control followed it", out);
    }
    else
    {
        _controls.SettleCurrent(EControlOutcome::NotSent, BEFORE, out);
    }
    _controls.SettleConfirmations("STOP control followed it", out);
    _controls.SettleWaiting(BEFORE, out);
    if (_output.TrySendStopControl(GetControlDeadline({}, now), out))
    {
        ++_stops;
        _stopsBeforeMonitor += bTaken ? 0U : 1U; // It has overtaken the STOP monitor, if that is what waits.
    }
    ArmControlTimer(out);
    SendNext(now, out);
}

/// One command in flight at a time: the MONITOR precedes the CONTROLs.
void ClientSession::Impl::SendNext(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || _monitor.IsInFlight() || _controls.IsInFlight())
    {
        return;
    }
    if (const std::optional<OpenStreamRequest> request = _monitor.BeginNextOrNull())
    {
        _stopsBeforeMonitor = _stops;
        SendAwaited(*request, now, out);
    }
    else if (const ControlRequest* control = _controls.BeginNextOrNull())
    {
        _output.SendCommand(*control, out);
    }
}

void ClientSession::Impl::SendAwaited(const OpenStreamRequest& request, Core::Now now, ClientActions& out)
{
    out.emplace_back(ClientStartTimer{EClientTimer::Answer, now.steady + _options.answerTimeout});
    _output.SendCommand(request, out);
}

void ClientSession::Impl::SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out)
{
    _output.SendUntil(request, deadline, out);
    ArmControlTimer(out);
}

Core::SteadyTime ClientSession::Impl::GetControlDeadline(std::chrono::milliseconds own, Core::Now now) const
{
    const std::chrono::milliseconds timeout = own.count() > 0 ? own : _options.controlTimeout;
    return timeout.count() > 0 ? now.steady + timeout : Core::SteadyTime::max();
}

Core::SteadyTime ClientSession::Impl::GetSendDeadline() const noexcept
{
    return std::min(_output.GetDeadline(), _controls.GetSendDeadline());
}

/// Ends what has waited for too long: for the socket, for its turn, for its confirmation.
void ClientSession::Impl::CheckControls(Core::Now now, ClientActions& out)
{
    if (now.steady >= GetSendDeadline())
    {
        Disconnect(
            EClientLossReason::SendTimeout,
            "timeout: a CONTROL could not be written to the connection",
            now,
            out);
        return;
    }
    _controls.SettleLate(now, out);
    ArmControlTimer(out);
}

void ClientSession::Impl::ArmControlTimer(ClientActions& out)
{
    const Core::SteadyTime deadline = std::min(GetSendDeadline(), _controls.GetDeadline());
    if (_controlTimer.ShouldStart(deadline))
    {
        out.emplace_back(ClientStartTimer{EClientTimer::Control, deadline});
    }
}

} // namespace ACS::OpenStream

#include "ClientEvents.hpp"
#include "ClientSession.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::OpenStream
{

using Detail::Report;

std::uint64_t ClientSession::Impl::SendControl(
    const ControlRequest& request,
    EControlTracking tracking,
    Core::Now now,
    ClientActions& out)
{
    if (tracking == EControlTracking::Streamed && _state == EClientState::Ready && !_outbox.IsFull())
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
    const bool bReady = _state == EClientState::Ready && !_outbox.IsFull();
    const std::string_view obstacle = bReady ? "too many CONTROLs wait" : "there is no session with the controller";
    if (call.tracking == EControlTracking::Streamed)
    {
        if (bReady)
        {
            SendUntil(call.request, GetControlDeadline(call.timeout, now), out);
        }
        else
        {
            Report(ClientControlFault{0, std::nullopt, fmt::format("not sent: {}", obstacle)}, out);
        }
        return token;
    }
    const Core::SteadyTime deadline = GetControlDeadline(call.timeout, now);
    if (!bReady || !_controls.TryPush(PendingControl{token, deadline, std::move(call)}))
    {
        Report(ClientControlSettled{token, EControlOutcome::NotSent, 0, std::nullopt, std::string(obstacle)}, out);
        return token;
    }
    SendNext(now, out);
    ArmControlTimer(out);
    return token;
}

Core::SteadyTime ClientSession::Impl::GetControlDeadline(std::chrono::milliseconds own, Core::Now now) const
{
    const std::chrono::milliseconds timeout = own.count() > 0 ? own : _options.controlTimeout;
    return timeout.count() > 0 ? now.steady + timeout : Core::SteadyTime::max();
}

/// Sends what must not leave later.
void ClientSession::Impl::SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out)
{
    _waitingDue = std::min(_waitingDue, deadline);
    SendNow(request, out);
    ArmControlTimer(out);
}

void ClientSession::Impl::SendControlInTurn(PendingControl control, ClientActions& out)
{
    _control = std::move(control);
    _bControlLeft = false;
    _bControlConfirmed = false;
    _inFlight = EInFlight::Control;
    OpenStreamCodec::EncodeRequest(_control.call.request, _outbox.GetLines());
    _inFlightMark = _outbox.GetMark();
    Flush(out);
}

/// No refusal came: that is success, unless a sample has to show it and none has yet.
void ClientSession::Impl::FinishControlWindow(Core::Now now, ClientActions& out)
{
    if (!_control.call.isConfirmed || _bControlConfirmed)
    {
        SettleInFlight(EControlOutcome::Accepted, {}, out);
        return;
    }
    FinishInFlight(out);
    _confirmations.push_back(Confirmation{
        _control.token,
        _controlLeftAt + _control.call.confirmWithin,
        std::move(_control.call.isConfirmed)});
    CheckControls(now, out);
}

void ClientSession::Impl::Confirm(const DataLine& sample, ClientActions& out)
{
    const bool bAsked = _inFlight == EInFlight::Control && _bControlLeft && _control.call.isConfirmed != nullptr;
    _bControlConfirmed = _bControlConfirmed || (bAsked && _control.call.isConfirmed(sample));
    std::erase_if(_confirmations, [&sample, &out](const Confirmation& confirmation) {
        const bool bHolds = confirmation.isConfirmed(sample);
        if (bHolds)
        {
            Report(ClientControlSettled{confirmation.token, EControlOutcome::Accepted, 0, std::nullopt, {}}, out);
        }
        return bHolds;
    });
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
    _controls.EraseIf([now, &out](const PendingControl& control) {
        const bool bLate = now.steady >= control.deadline;
        if (bLate)
        {
            constexpr const char* DETAIL = "its turn did not come in time";
            Report(ClientControlSettled{control.token, EControlOutcome::NotSent, 0, std::nullopt, DETAIL}, out);
        }
        return bLate;
    });
    std::erase_if(_confirmations, [now, &out](const Confirmation& confirmation) {
        const bool bLate = now.steady >= confirmation.deadline;
        if (bLate)
        {
            constexpr const char* DETAIL = "no refusal came, and no sample showed its effect in time";
            Report(
                ClientControlSettled{confirmation.token, EControlOutcome::Unconfirmed, 0, std::nullopt, DETAIL},
                out);
        }
        return bLate;
    });
    ArmControlTimer(out);
}

/// When the first of the CONTROLs that have been given to the socket has to have left.
Core::SteadyTime ClientSession::Impl::GetSendDeadline() const noexcept
{
    const bool bTracked = _inFlight == EInFlight::Control && !_bControlLeft;
    return std::min({_waitingDue, _sendingDue, bTracked ? _control.deadline : Core::SteadyTime::max()});
}

/// Started forward only, and again where it fires early: see the watchdog of ServerSession.
void ClientSession::Impl::ArmControlTimer(ClientActions& out)
{
    Core::SteadyTime earliest = GetSendDeadline();
    for (const PendingControl& control : std::as_const(_controls))
    {
        earliest = std::min(earliest, control.deadline);
    }
    for (const Confirmation& confirmation : _confirmations)
    {
        earliest = std::min(earliest, confirmation.deadline);
    }
    if (earliest != Core::SteadyTime::max() && (!_bControlTimerArmed || earliest < _controlTimerAt))
    {
        _bControlTimerArmed = true;
        _controlTimerAt = earliest;
        out.emplace_back(ClientStartTimer{EClientTimer::Control, earliest});
    }
}

void ClientSession::Impl::SettleConfirmations(std::string_view detail, ClientActions& out)
{
    for (const Confirmation& confirmation : std::exchange(_confirmations, {}))
    {
        Report(
            ClientControlSettled{confirmation.token, EControlOutcome::Unknown, 0, std::nullopt, std::string(detail)},
            out);
    }
}

void ClientSession::Impl::StopControl(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready)
    {
        return;
    }
    SettleInFlight(EControlOutcome::Unknown, "STOP control followed it", out);
    SettleConfirmations("STOP control followed it", out);
    SettleWaiting("STOP control went before it", out);
    // One that waits and that nothing follows suffices: repeated for a socket that does not take it, it would fill the outbox.
    if (_outbox.WasTaken(_stopMark) || _outbox.GetMark() != _stopMark)
    {
        SendUntil(StopRequest{EStopTarget::Control}, GetControlDeadline({}, now), out);
        _stopMark = _outbox.GetMark();
    }
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
    if (!IsAwaited(EInFlight::Control))
    {
        Report(ClientControlFault{status, std::move(bodyOrNull), std::move(detail)}, out);
        return;
    }
    FinishInFlight(out);
    Report(
        ClientControlSettled{
            _control.token,
            EControlOutcome::Refused,
            status,
            std::move(bodyOrNull),
            std::move(detail)},
        out);
}

/// Ends the tracking of a CONTROL in flight, if there is one.
void ClientSession::Impl::SettleInFlight(EControlOutcome outcome, std::string_view detail, ClientActions& out)
{
    if (_inFlight == EInFlight::Control)
    {
        FinishInFlight(out);
        Report(ClientControlSettled{_control.token, outcome, 0, std::nullopt, std::string(detail)}, out);
    }
}

void ClientSession::Impl::SettleWaiting(std::string_view detail, ClientActions& out)
{
    while (const std::optional<PendingControl> control = _controls.PopFrontOrNull())
    {
        Report(
            ClientControlSettled{control->token, EControlOutcome::NotSent, 0, std::nullopt, std::string(detail)},
            out);
    }
}

} // namespace ACS::OpenStream

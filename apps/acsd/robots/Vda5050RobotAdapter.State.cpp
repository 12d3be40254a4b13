#include "robots/Vda5050RobotAdapter.hpp"

#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

} // namespace

void Vda5050RobotAdapter::OnState(Core::Now now, AdapterActions& out)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    _report.Update(state, _job.IsShownRunning(state), _methods.GetPositions());
    _maps.OnReported(state.maps);
    _operatorActions.OnState(state);
    RecoverJob(now, out); // first: a job of before a restart does not make the vehicle occupied
    if (const std::string* const commandOrNull = _repetition.FindCommandOrNull(state.orderID); commandOrNull != nullptr)
    {
        _report.SetShownCommand(*commandOrNull); // the engine does not know the orderId
    }
    const bool bOccupied = IsOccupied();
    if (!bOccupied && _session.CanTakeOrder())
    {
        RequestMap(now);
    }
    _report.AddErrors(_maps.ListErrors());
    _report.SetOccupied(bOccupied, state);
    SetOnline(_session.IsReady(), now, out);
    out.emplace_back(RaiseEvent{_report.GetState()});
    if (_bOnline && !_bFactsheetAwaited && !_drive.has_value())
    {
        if (const auto deferredOrNull = _job.TakeDeferredOrNull(); deferredOrNull.has_value())
        {
            ContinueJob(*deferredOrNull, now, out); // of before an outage
        }
    }
    VerifyLoads(out);
    EvaluateInterruption(false, out);
    if (bOccupied && _session.GetOrderPhase() == VDA5050::EOrderPhase::None)
    {
        _foreignOrder.Cancel(_session, now, _sessionActions);
    }
    else if (bOccupied && IsDrive(_session.GetOrderID()))
    {
        AbandonDrive("the vehicle executes another order", now, out);
    }
    else if (bOccupied && IsJob(_session.GetOrderID()) && _job.TryWithdraw())
    {
        CancelOrder(std::string(_session.GetOrderID()), now, out);
    }
}

bool Vda5050RobotAdapter::IsOccupied() const
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    if (IsDrive(state.orderID) || IsJob(state.orderID))
    {
        return false;
    }
    if (IsDrive(_session.GetOrderID()) || IsJob(_session.GetOrderID()))
    {
        return ForeignOrder::IsDriven(state); // what remains of its last order may still be shown
    }
    return ForeignOrder::IsExecuted(state, [this](const VDA5050::ActionState& action) {
        return _operatorActions.IsRequested(action.actionID) || _commandedActions.IsCommanded(action);
    });
}

void Vda5050RobotAdapter::CancelAbandoned(Core::Now now)
{
    if (IsDrive(_session.GetOrderID()) && _drive->IsCancelDue(now))
    {
        static_cast<void>(_session.Cancel(now, _sessionActions));
    }
}

void Vda5050RobotAdapter::SetOnline(bool bOnline, Core::Now now, AdapterActions& out)
{
    if (!bOnline && _session.GetLink() != VDA5050::EVehicleLink::Online)
    {
        _operatorActions.OnDisconnected(_session);
    }
    if (std::exchange(_bOnline, bOnline) == bOnline)
    {
        return;
    }
    if (bOnline)
    {
        UpdateJobCheck(out); // before the engine gives it a plan
        UpdateCompatibility(now, out);
    }
    else
    {
        const Planning::StartJob* const jobOrNull = _job.GetRunningOrNull();
        const bool bHeld = jobOrNull != nullptr && IsJob(_session.GetOrderID()) && !_session.IsOrderSent();
        const bool bPending = jobOrNull != nullptr && IsPending(jobOrNull->commandID);
        _job.OnOffline(bHeld || bPending);
        if (bHeld)
        {
            static_cast<void>(_session.Cancel(now, _sessionActions)); // of the session only: it was not sent
        }
        if (bPending)
        {
            _pendingOrder.reset();
        }
        _report.OnDisconnected();
    }
    if (_bFactsheetAwaited && bOnline)
    {
        out.emplace_back(Planning::StartAdapterTimer{FACTSHEET_TIMER, FACTSHEET_TIMEOUT});
    }
    else if (_bFactsheetAwaited)
    {
        out.emplace_back(Planning::CancelAdapterTimer{FACTSHEET_TIMER});
    }
    out.emplace_back(RaiseEvent{Planning::LinkChanged{bOnline}});
}

void Vda5050RobotAdapter::RequestMap(Core::Now now)
{
    std::optional<VDA5050::Action> requestOrNull = _maps.MakeRequestOrNull();
    if (!requestOrNull.has_value())
    {
        return;
    }
    Core::Result<std::string> sent = _session.SendInstantAction(std::move(*requestOrNull), now, _sessionActions);
    if (sent)
    {
        _maps.OnSent(std::move(*sent));
        return;
    }
    _maps.OnNotSent(Core::Describe(sent.error()));
}

void Vda5050RobotAdapter::OnPosition(const VDA5050::PositionReceived& received, AdapterActions& out)
{
    _report.OnPosition(received.position);
    if (_bOnline)
    {
        out.emplace_back(RaiseEvent{_report.GetState()});
    }
}

} // namespace ACS::Acsd

#include "robots/Vda5050RobotAdapter.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

} // namespace

bool Vda5050RobotAdapter::IsOccupied(const VDA5050::StateMessage& state) const
{
    if (_session.GetOrderPhase() != VDA5050::EOrderPhase::None || state.orderID.empty())
    {
        return false;
    }
    const bool bActs = std::ranges::any_of(state.actionStates, [](const VDA5050::ActionState& action) {
        return action.actionStatus == VDA5050::EActionStatus::Initializing
            || action.actionStatus == VDA5050::EActionStatus::Running
            || action.actionStatus == VDA5050::EActionStatus::Paused;
    });
    return bActs || !state.nodeStates.empty() || !state.edgeStates.empty();
}

void Vda5050RobotAdapter::CancelForeignOrder(Core::Now now)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    const bool bDrives = !state.nodeStates.empty() || !state.edgeStates.empty();
    if (!bDrives || _foreignOrderID == state.orderID)
    {
        return;
    }
    VDA5050::Action action;
    action.actionType = VDA5050::ActionTypes::CANCEL_ORDER;
    if (_session.SendInstantAction(std::move(action), now, _sessionActions))
    {
        _foreignOrderID = state.orderID;
    }
}

void Vda5050RobotAdapter::OnState(Core::Now now, AdapterActions& out)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    _report.Update(state, IsJobRunning(state), _methods.GetPositions());
    _maps.OnReported(state.maps);
    RecoverJob(now, out); // first: a job of before a restart does not make the vehicle occupied
    const bool bOccupied = IsOccupied(state);
    if (!bOccupied && _session.CanTakeOrder())
    {
        RequestMap(now);
    }
    _report.AddErrors(_maps.ListErrors());
    _report.SetOccupied(bOccupied, state);
    SetOnline(_session.IsReady(), now, out);
    out.emplace_back(RaiseEvent{_report.GetState()});
    VerifyLoads(out);
    EvaluateInterruption(false, out);
    if (bOccupied)
    {
        CancelForeignOrder(now);
    }
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

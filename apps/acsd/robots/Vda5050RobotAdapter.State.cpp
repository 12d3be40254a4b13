#include "robots/Vda5050RobotAdapter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

Planning::RobotError MakeError(const VDA5050::VehicleError& error)
{
    const bool bFatal = error.errorLevel == VDA5050::EErrorLevel::Fatal;
    return {
        "AGV-" + error.errorType,
        bFatal ? Planning::EAlarmLevel::Heavy : Planning::EAlarmLevel::Light,
        error.errorDescription.empty() ? error.errorType : error.errorDescription};
}

constexpr double FULL_BATTERY = 100;

/// No site is as large, in m: a vehicle that tells more does not know where it is.
constexpr double FARTHEST = 1e7;

void TakePose(const VDA5050::AgvPosition& position, Planning::StateChanged& state)
{
    state.x = position.x;
    state.y = position.y;
    state.theta = position.theta;
    const bool bPossible = std::abs(position.x) <= FARTHEST && std::abs(position.y) <= FARTHEST;
    state.bPoseKnown = position.bPositionInitialized && bPossible;
}

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

/// The state's member paused is optional: where it is missing, the ends of these two actions say it.
void Vda5050RobotAdapter::FollowPauseActions(const VDA5050::StateMessage& state)
{
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        const bool bStart = action.actionType == VDA5050::ActionTypes::START_PAUSE;
        const bool bStop = action.actionType == VDA5050::ActionTypes::STOP_PAUSE;
        if (action.actionStatus == VDA5050::EActionStatus::Finished && (bStart || bStop))
        {
            _bPauseDone = bStart;
        }
    }
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

void Vda5050RobotAdapter::TakeState(Core::Now now, AdapterActions& out)
{
    const VDA5050::StateMessage& state = *_session.GetStateOrNull();
    if (state.agvPosition.has_value())
    {
        TakePose(*state.agvPosition, _state);
        _bPoseInState = true;
    }
    else if (std::exchange(_bPoseInState, false))
    {
        _state.bPoseKnown = false; // it knows no longer; one that only ever tells it by visualization has lost nothing
    }
    _state.batteryPercent = std::clamp(state.batteryState.batteryCharge, 0.0, FULL_BATTERY);
    _state.lastNodeID = state.lastNodeID;
    _state.bDriving = state.bDriving;
    _state.bCharging = state.batteryState.bCharging;
    FollowPauseActions(state);
    // An action that the vehicle cannot pause comes to its end first: before that it does not stand.
    _state.bPaused = state.bPaused.value_or(_bPauseDone) && !IsJobRunning(state);
    _state.bAutomatic = state.operatingMode == VDA5050::EOperatingMode::Automatic
        || state.operatingMode == VDA5050::EOperatingMode::SemiAutomatic;
    _state.bSafetyStop =
        state.safetyState.emergencyStop != VDA5050::EEmergencyStop::None || state.safetyState.bFieldViolation;
    _state.errors.clear();
    for (const VDA5050::VehicleError& error : state.errors)
    {
        _state.errors.push_back(MakeError(error));
    }
    FindJob(now, out); // before the state is judged: it may be our own job that keeps the vehicle busy
    _state.bOccupied = IsOccupied(state);
    _state.shownCommandID = state.orderID;
    _state.heldNodeIDs.clear();
    for (const VDA5050::NodeState& node : state.nodeStates)
    {
        if (_state.bOccupied && node.bReleased)
        {
            _state.heldNodeIDs.push_back(node.nodeID);
        }
    }
    _state.loads = _methods.GetPositions().MakePortLoadsOrNull(state);
    SetOnline(_session.IsReady(), out);
    out.emplace_back(RaiseEvent{_state});
    VerifyLoads(out);
    if (_state.bOccupied)
    {
        CancelForeignOrder(now);
    }
}

void Vda5050RobotAdapter::TakePosition(const VDA5050::PositionReceived& received, AdapterActions& out)
{
    TakePose(received.position, _state);
    if (_bOnline)
    {
        out.emplace_back(RaiseEvent{_state});
    }
}

} // namespace ACS::Acsd

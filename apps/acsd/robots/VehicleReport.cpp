#include "robots/VehicleReport.hpp"

#include <acs/core/ShortText.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr double FULL_BATTERY = 100;

/// Metres. No site is as large: a vehicle that reports a greater coordinate is not localised.
constexpr double FARTHEST = 1e7;

using ErrorList = std::vector<std::reference_wrapper<const VDA5050::VehicleError>>;

/// Errors that are kept of one state: more than the engine sets alarms for.
constexpr std::size_t MOST_ERRORS = 100;

bool IsFatal(const VDA5050::VehicleError& error)
{
    return error.errorLevel == VDA5050::EErrorLevel::Fatal;
}

Planning::RobotError MakeError(const VDA5050::VehicleError& error)
{
    return {
        "AGV-" + Core::ShortenText(error.errorType),
        IsFatal(error) ? Planning::EAlarmLevel::Heavy : Planning::EAlarmLevel::Light,
        Core::ShortenText(error.errorDescription.empty() ? error.errorType : error.errorDescription)};
}

/// One error for each type, the most severe one, in the order of the state.
ErrorList ListErrors(const VDA5050::StateMessage& state)
{
    ErrorList errors;
    std::unordered_map<std::string_view, std::size_t> positions; // in the list, by type
    for (const VDA5050::VehicleError& error : state.errors)
    {
        const auto [found, bNew] = positions.try_emplace(error.errorType, errors.size());
        if (bNew)
        {
            errors.emplace_back(error);
        }
        else if (IsFatal(error) && !IsFatal(errors[found->second]))
        {
            errors[found->second] = error;
        }
    }
    return errors;
}

} // namespace

void VehicleReport::Update(const VDA5050::StateMessage& state, bool bJobRunning, const LoadPositions& positions)
{
    if (state.agvPosition.has_value())
    {
        UpdatePose(*state.agvPosition);
        _bPoseInState = true;
    }
    else if (std::exchange(_bPoseInState, false))
    {
        // The vehicle has lost its position. One that reports it only by visualization messages has not.
        _state.bPoseKnown = false;
    }
    _state.batteryPercent = std::clamp(state.batteryState.batteryCharge, 0.0, FULL_BATTERY);
    _state.lastNodeID = state.lastNodeID;
    _state.bDriving = state.bDriving;
    _state.bCharging = state.batteryState.bCharging;
    UpdatePause(state, bJobRunning);
    _state.bAutomatic = state.operatingMode == VDA5050::EOperatingMode::Automatic
        || state.operatingMode == VDA5050::EOperatingMode::SemiAutomatic;
    _state.bSafetyStop =
        state.safetyState.emergencyStop != VDA5050::EEmergencyStop::None || state.safetyState.bFieldViolation;
    UpdateErrors(state);
    _state.restartEvidence.commandID = state.orderID;
    _state.loads = positions.MakePortLoadsOrNull(state);
}

void VehicleReport::OnDisconnected()
{
    _state.bPoseKnown = false;
    _bPauseDone = false;
    _pauseIDs.clear();
}

void VehicleReport::UpdatePose(const VDA5050::AgvPosition& position)
{
    _state.x = position.x;
    _state.y = position.y;
    _state.theta = position.theta;
    const bool bPossible = std::abs(position.x) <= FARTHEST && std::abs(position.y) <= FARTHEST;
    _state.bPoseKnown = position.bPositionInitialized && bPossible;
}

/// The member paused is optional. Where it is absent, the vehicle is paused from the end of startPause to the end of
/// stopPause, of which a state may list the newest one first. An action that the vehicle cannot pause runs to its end first: until
/// then the vehicle is not paused.
void VehicleReport::UpdatePause(const VDA5050::StateMessage& state, bool bJobRunning)
{
    std::vector<std::string> finishedIDs;
    for (const VDA5050::ActionState& action : state.actionStates)
    {
        const bool bStart = action.actionType == VDA5050::ActionTypes::START_PAUSE;
        const bool bStop = action.actionType == VDA5050::ActionTypes::STOP_PAUSE;
        if (action.actionStatus != VDA5050::EActionStatus::Finished || (!bStart && !bStop))
        {
            continue;
        }
        finishedIDs.push_back(action.actionID);
        if (std::ranges::count(_pauseIDs, action.actionID) == 0)
        {
            _bPauseDone = bStart;
        }
    }
    _pauseIDs = std::move(finishedIDs);
    _state.bPaused = state.bPaused.value_or(_bPauseDone) && !bJobRunning;
}

void VehicleReport::UpdateErrors(const VDA5050::StateMessage& state)
{
    ErrorList errors = ListErrors(state);
    _state.omittedErrors = errors.size() - std::min(errors.size(), MOST_ERRORS);
    if (_state.omittedErrors > 0)
    {
        std::stable_partition(errors.begin(), errors.end(), IsFatal);
        errors.erase(errors.begin() + MOST_ERRORS, errors.end());
    }
    _state.errors.clear();
    for (const VDA5050::VehicleError& error : errors)
    {
        _state.errors.push_back(MakeError(error));
    }
}

void VehicleReport::SetShownCommand(std::string commandID)
{
    _state.restartEvidence.commandID = std::move(commandID);
}

void VehicleReport::AddErrors(const std::vector<Planning::RobotError>& errors)
{
    _state.errors.insert(_state.errors.end(), errors.begin(), errors.end());
}

void VehicleReport::OnPosition(const VDA5050::AgvPosition& position)
{
    UpdatePose(position);
}

void VehicleReport::SetOccupied(bool bOccupied, const VDA5050::StateMessage& state)
{
    _state.bOccupied = bOccupied;
    _state.heldNodeIDs.clear();
    for (const VDA5050::NodeState& node : state.nodeStates)
    {
        if (bOccupied && node.bReleased)
        {
            _state.heldNodeIDs.push_back(node.nodeID);
        }
    }
}

const Planning::StateChanged& VehicleReport::GetState() const noexcept
{
    return _state;
}

} // namespace ACS::Acsd

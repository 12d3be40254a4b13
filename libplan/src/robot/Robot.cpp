#include "robot/Robot.hpp"

#include <algorithm>

namespace ACS::Planning
{

const std::string& Robot::GetID() const
{
    return options->robotID.GetText();
}

ELoad Robot::GetLoad() const
{
    const bool bLoaded = std::ranges::any_of(ports.GetCarriers(), [](const std::optional<std::string>& carrierOrNull) {
        return carrierOrNull.has_value();
    });
    return bLoaded ? ELoad::Loaded : ELoad::Empty;
}

EUnavailability Robot::GetUnavailability() const
{
    if (!view.bOnline)
    {
        return EUnavailability::Link;
    }
    if (!view.state.has_value() || !place.bPlaced || !place.node.has_value())
    {
        return EUnavailability::Place;
    }
    // A robot in maintenance completes its plan and its drive first.
    if (view.bInMaintenance && planOrNull == nullptr && !drive.has_value())
    {
        return EUnavailability::Maintenance;
    }
    const StateChanged& state = *view.state;
    const bool bFatal =
        std::ranges::any_of(state.errors, [](const RobotError& error) { return error.level == EAlarmLevel::Heavy; });
    if (bFatal)
    {
        return EUnavailability::Error;
    }
    if (state.bSafetyStop)
    {
        return EUnavailability::SafetyStop;
    }
    if (state.bPaused || IsHeld())
    {
        return EUnavailability::Paused;
    }
    if (!state.bAutomatic)
    {
        return EUnavailability::Manual;
    }
    const bool bOccupied = state.bOccupied || control.bStandstillAwaited || job.IsOverdue();
    if (bOccupied)
    {
        return EUnavailability::Occupied;
    }
    if (!view.incompatibility.empty())
    {
        return EUnavailability::Incompatible;
    }
    return view.rejections.GetState() == ERejection::None ? EUnavailability::None : EUnavailability::Rejecting;
}

std::string Robot::Describe(EUnavailability unavailability) const
{
    switch (unavailability)
    {
        case EUnavailability::None:
            return {};
        case EUnavailability::Link:
            return "no connection";
        case EUnavailability::Place:
            if (!view.state.has_value())
            {
                return "no state received";
            }
            return view.state->lastNodeID.empty() ? "position unknown: it reports no node"
                                                  : "position unknown, see ACS-1003";
        case EUnavailability::Maintenance:
            return "in maintenance";
        case EUnavailability::Error:
        {
            const std::vector<RobotError>& errors = view.state->errors;
            return "error " + std::ranges::find(errors, EAlarmLevel::Heavy, &RobotError::level)->errorCode;
        }
        case EUnavailability::SafetyStop:
            return "emergency or protective stop";
        case EUnavailability::Paused:
            return "paused";
        case EUnavailability::Manual:
            return "not in automatic mode";
        case EUnavailability::Occupied:
            return "busy with work of an ended plan";
        case EUnavailability::Incompatible:
            return "incompatible, see ACS-1013";
        case EUnavailability::Rejecting:
            return (view.rejections.GetState() == ERejection::Exhausted ? "rejects its commands: "
                                                                        : "rejected its command, which is sent again: ")
                + view.rejections.GetReason();
        default:
            return "unavailable";
    }
}

bool Robot::IsUsable() const
{
    return GetUnavailability() == EUnavailability::None;
}

bool Robot::IsUnfit() const
{
    return view.rejections.GetState() == ERejection::Exhausted || !view.incompatibility.empty();
}

bool Robot::IsFree() const
{
    return planOrNull == nullptr && !drive.has_value() && !IsStopping() && !charging.IsBatteryLow() && IsUsable();
}

bool Robot::IsStopping() const
{
    return !drive.has_value() && !place.aheadNodes.empty() && view.state.has_value() && view.state->bDriving;
}

bool Robot::CanAdvance() const
{
    return IsUsable() ? !control.pause.IsPaused() : !view.bOnline && !control.pause.IsPaused() && !IsHeld();
}

bool Robot::IsHeld() const
{
    return planOrNull != nullptr
        && (planOrNull->record.progress.state == EPlanState::Paused
            || planOrNull->record.progress.control == EPlanControl::Pause);
}

bool Robot::IsEnding() const
{
    if (planOrNull == nullptr)
    {
        return false;
    }
    const std::optional<EPlanControl>& open = planOrNull->record.progress.control;
    return open == EPlanControl::Cancel || open == EPlanControl::Abort;
}

bool IsMoreUrgent(const Robot* leftOrNull, const Robot* rightOrNull)
{
    if (leftOrNull->planOrNull != nullptr && rightOrNull->planOrNull != nullptr)
    {
        return leftOrNull->planOrNull->key < rightOrNull->planOrNull->key;
    }
    if (leftOrNull->planOrNull != nullptr || rightOrNull->planOrNull != nullptr)
    {
        return leftOrNull->planOrNull != nullptr;
    }
    return leftOrNull->index < rightOrNull->index;
}

} // namespace ACS::Planning

#include "dispatch/StatusPublisher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

StatusPublisher::StatusPublisher(
    EngineState& engine,
    const StallWatch& stalls,
    const WaitingRobots& waiting,
    const WaitReasons& waits)
    : _options(engine.options),
      _site(engine.site),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _stalls(stalls),
      _waiting(waiting),
      _waits(waits),
      _last(engine.options.robots.size())
{
}

ERobotStatus StatusPublisher::DeriveStatus(const Robot& robot) const
{
    if (!robot.view.bOnline)
    {
        return ERobotStatus::Disconnected;
    }
    if (!robot.view.state.has_value() || !robot.place.bPlaced)
    {
        return ERobotStatus::Init;
    }
    const StateChanged& state = *robot.view.state;
    const bool bFatal =
        std::ranges::any_of(state.errors, [](const RobotError& error) { return error.level == EAlarmLevel::Heavy; });
    if (bFatal || state.bSafetyStop)
    {
        return ERobotStatus::Error;
    }
    const ActivePlan* planOrNull = robot.planOrNull;
    const bool bPlanPaused = planOrNull != nullptr && planOrNull->record.progress.state == EPlanState::Paused
        && planOrNull->record.progress.control.value_or(EPlanControl::Pause) == EPlanControl::Pause;
    const bool bOutOfService = robot.view.bInMaintenance && planOrNull == nullptr && !robot.drive.has_value();
    if (state.bPaused || bPlanPaused || bOutOfService)
    {
        return ERobotStatus::Stopped;
    }
    if (!state.bAutomatic)
    {
        return ERobotStatus::Manual;
    }
    if (state.bCharging)
    {
        return ERobotStatus::Charging;
    }
    if (robot.activity == EActivity::Works)
    {
        return ERobotStatus::Working;
    }
    if (robot.drive.has_value())
    {
        return DeriveDriveStatus(robot, *robot.drive);
    }
    const bool bWaitsForWay = robot.planOrNull != nullptr && !_waiting.IsAtPlace(robot);
    if (bWaitsForWay || (state.bOccupied && state.bDriving))
    {
        return ERobotStatus::Moving;
    }
    if (robot.planOrNull != nullptr || state.bOccupied || robot.job.IsOverdue())
    {
        return ERobotStatus::Working;
    }
    return ERobotStatus::Idle;
}

ERobotStatus StatusPublisher::DeriveDriveStatus(const Robot& robot, const ActiveDrive& drive) const
{
    const bool bWaits = drive.passed + 1 >= drive.grantedCount && drive.grantedCount < drive.nodes.size();
    if (bWaits)
    {
        return ERobotStatus::Moving;
    }
    const std::vector<RouteNode>& nodes = drive.route.nodes;
    const bool bArrivalDue =
        drive.goal == EDriveGoal::Step && robot.planOrNull != nullptr && !robot.planOrNull->bStepArrived;
    if (drive.bTaken && !bArrivalDue && drive.IsApproaching()
        && _site.FindStationAtOrNull(nodes.back().nodeID) != nullptr)
    {
        return ERobotStatus::Docking;
    }
    const bool bLeaves = drive.passed == 0 && _site.FindStationAtOrNull(nodes.front().nodeID) != nullptr;
    return bLeaves ? ERobotStatus::UnDocking : ERobotStatus::Moving;
}

std::string StatusPublisher::GetReportedPosition(const Robot& robot, ERobotStatus status) const
{
    const bool bArrives = status == ERobotStatus::Arrival || status == ERobotStatus::Docking;
    if (!robot.drive.has_value() || (!bArrives && _options.movingPosition == EMovingPosition::Last))
    {
        return robot.place.position;
    }
    if (!bArrives && _options.movingPosition == EMovingPosition::None)
    {
        return {};
    }
    const SiteStation* stationOrNull = _site.FindStationAtOrNull(robot.drive->route.nodes.back().nodeID);
    return stationOrNull == nullptr ? robot.place.position : stationOrNull->stationID;
}

std::string StatusPublisher::DescribeStatus(const Robot& robot) const
{
    if (robot.view.bInMaintenance)
    {
        return "In maintenance.";
    }
    if (_stalls.IsStalled(robot))
    {
        return robot.drive.has_value()
            ? fmt::format("Robot stalled: node {} not reached.", robot.drive->GetNextNodeID())
            : fmt::format("Robot stalled: job {} not confirmed.", robot.job.GetOrNull()->jobID);
    }
    if (robot.planOrNull != nullptr && robot.parking.retreatNode.has_value() && robot.search.yield.has_value())
    {
        return fmt::format("Yields to {}.", _fleet[robot.search.yield->leader].GetID());
    }
    if (robot.planOrNull != nullptr)
    {
        const std::optional<WaitReason> reason = _waits.DescribeBegunOrNull(*robot.planOrNull);
        return reason.has_value() ? reason->message : std::string();
    }
    if (const EUnavailability unavailability = robot.GetUnavailability(); unavailability != EUnavailability::None)
    {
        return fmt::format("{}: {}.", robot.GetID(), robot.Describe(unavailability));
    }
    if (!robot.search.block.empty())
    {
        return fmt::format("{} waits: {}.", robot.GetID(), robot.search.block);
    }
    if (std::string wait = _waits.DescribeIdle(robot); !wait.empty())
    {
        return wait;
    }
    return robot.charging.IsBatteryLow() ? "Battery low." : "";
}

RobotStatus StatusPublisher::MakeStatus(const Robot& robot, ERobotStatus status) const
{
    RobotStatus made;
    made.robotID = robot.GetID();
    made.type = robot.options->type;
    made.status = status;
    made.position = GetReportedPosition(robot, status);
    made.bInMaintenance = robot.view.bInMaintenance;
    made.message = DescribeStatus(robot);
    made.carrierIDs = robot.ports.GetCarriers();
    if (robot.planOrNull != nullptr)
    {
        const ActivePlan& plan = *robot.planOrNull;
        made.planID = plan.record.plan.planID;
        made.stepNo = plan.record.plan.steps[plan.step].stepNo;
        if (robot.activity == EActivity::Works && HasJob(plan))
        {
            made.jobID = GetJobID(plan);
        }
    }
    return made;
}

void StatusPublisher::PublishStatus(const Robot& robot, ERobotStatus status)
{
    RobotStatus made = MakeStatus(robot, status);
    RobotStatus& last = _last[robot.index];
    if (made == last)
    {
        return;
    }
    last = std::move(made);
    _transaction.PublishRobotStatus(last);
}

void StatusPublisher::PublishStatusChanges()
{
    for (const std::size_t index : TakeInOrder(_fleet.GetChanged().status))
    {
        Robot& robot = _fleet[index];
        if (robot.changes.TryUnmarkStatus())
        {
            PublishStatus(robot, DeriveStatus(robot));
        }
    }
}

void StatusPublisher::Reset(Robot& robot)
{
    _last[robot.index] = MakeStatus(robot, DeriveStatus(robot));
    static_cast<void>(robot.changes.TryUnmarkStatus());
}

const std::vector<RobotStatus>& StatusPublisher::GetRobotStatuses() const noexcept
{
    return _last;
}

} // namespace ACS::Planning

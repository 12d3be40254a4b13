#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

/// Section 5: the first that holds.
ERobotStatus PlanEngine::Impl::DeriveStatus(const Robot& robot) const
{
    if (!robot.bOnline)
    {
        return ERobotStatus::Disconnected;
    }
    if (!robot.state.has_value() || !robot.bPlaced)
    {
        return ERobotStatus::Init;
    }
    const StateChanged& state = *robot.state;
    const bool bFatal =
        std::ranges::any_of(state.errors, [](const RobotError& error) { return error.level == EAlarmLevel::Heavy; });
    if (bFatal || state.bSafetyStop)
    {
        return ERobotStatus::Error;
    }
    const ActivePlan* planOrNull = robot.planOrNull;
    const bool bPlanPaused = planOrNull != nullptr && planOrNull->record.progress.state == EPlanState::Paused
        && planOrNull->record.progress.control.value_or(EPlanControl::Pause) == EPlanControl::Pause;
    const bool bOutOfService = robot.bInMaintenance && planOrNull == nullptr && !robot.drive.has_value();
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
    const bool bWaitsForWay = robot.planOrNull != nullptr && !IsAtPlace(robot);
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

/// The first edge leads out of a station, the last one into one. A robot that waits between them for others is not docking,
/// nor is one whose Arrival is not reported because its drive is to be cancelled.
ERobotStatus PlanEngine::Impl::DeriveDriveStatus(const Robot& robot, const ActiveDrive& drive) const
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

/// Whether the robot stands where its present step is done.
bool PlanEngine::Impl::IsAtPlace(const Robot& robot) const
{
    if (robot.planOrNull == nullptr || robot.drive.has_value() || !robot.node.has_value())
    {
        return false;
    }
    const ActivePlan& plan = *robot.planOrNull;
    return robot.node
        == _admission.FindDockOrNull(plan.resolved.steps[plan.step].stationID, robot.options->vehicleTypeID);
}

/// Who has reached a station's last node before the dock is as good as there.
std::string PlanEngine::Impl::GetReportedPosition(const Robot& robot, ERobotStatus status) const
{
    const bool bArrives = status == ERobotStatus::Arrival || status == ERobotStatus::Docking;
    if (!robot.drive.has_value() || (!bArrives && _options.movingPosition == EMovingPosition::Last))
    {
        return robot.position;
    }
    if (!bArrives && _options.movingPosition == EMovingPosition::None)
    {
        return {};
    }
    const SiteStation* stationOrNull = _site.FindStationAtOrNull(robot.drive->route.nodes.back().nodeID);
    return stationOrNull == nullptr ? robot.position : stationOrNull->stationID;
}

/// Why the robot does not do more than it does; empty where nothing keeps it.
std::string PlanEngine::Impl::DescribeStatus(const Robot& robot) const
{
    if (robot.bInMaintenance)
    {
        return "In maintenance.";
    }
    if (robot.stall.IsStalled() && robot.drive.has_value())
    {
        return fmt::format("Robot stalled: node {} not reached.", robot.drive->GetNextNodeID());
    }
    if (robot.planOrNull != nullptr && robot.retreatNode.has_value() && robot.yield.has_value())
    {
        return fmt::format("Makes way for {}.", GetRobotID(_robots[robot.yield->leader]));
    }
    if (robot.planOrNull != nullptr)
    {
        const std::optional<WaitReason> reason = DescribeBegunOrNull(*robot.planOrNull);
        return reason.has_value() ? reason->message : std::string();
    }
    if (const EUnavailability unavailability = GetUnavailability(robot); unavailability != EUnavailability::None)
    {
        return fmt::format("{}: {}.", GetRobotID(robot), Describe(robot, unavailability));
    }
    return robot.charging.IsBatteryLow() ? "Battery low." : "";
}

RobotStatus PlanEngine::Impl::MakeStatus(const Robot& robot, ERobotStatus status) const
{
    RobotStatus made;
    made.robotID = GetRobotID(robot);
    made.type = robot.options->type;
    made.status = status;
    made.position = GetReportedPosition(robot, status);
    made.bInMaintenance = robot.bInMaintenance;
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

const std::string& PlanEngine::Impl::GetRobotID(const Robot& robot) const
{
    return _options.robots[robot.index].robotID.GetText();
}

PlanSummary MakeSummary(const PlanRecord& record)
{
    PlanSummary summary;
    const PlanProgress& progress = record.progress;
    summary.planID = record.plan.planID;
    summary.state = progress.state;
    summary.robotID = progress.robotID.empty() ? std::nullopt : std::optional(progress.robotID);
    summary.startTime = progress.startedAt.value_or(record.acceptedAt);
    summary.endTime = progress.endedAt;
    if (progress.state == EPlanState::Completed)
    {
        return summary;
    }
    std::size_t step = 0;
    while (
        step + 1 < progress.steps.size()
        && (progress.steps[step].state == EStepState::Completed || progress.steps[step].state == EStepState::Skipped))
    {
        ++step;
    }
    const std::vector<EJobState>& jobs = progress.steps[step].jobs;
    std::size_t job = 0;
    while (job + 1 < jobs.size() && jobs[job] == EJobState::Completed)
    {
        ++job;
    }
    summary.stepNo = record.plan.steps[step].stepNo;
    summary.currentAction = record.plan.steps[step].action;
    if (!jobs.empty())
    {
        summary.jobID = record.plan.steps[step].jobs[job].jobID;
    }
    return summary;
}

std::vector<OutboxEntry> PlanEngine::Impl::GetUnacknowledged() const
{
    std::vector<OutboxEntry> entries;
    std::ranges::copy_if(_outbox.GetUnacknowledged(), std::back_inserter(entries), [this](const OutboxEntry& entry) {
        return !_backlog.IsHeldBack(entry);
    });
    return entries;
}

OutboxSummary PlanEngine::Impl::GetOutboxSummary() const
{
    const std::deque<OutboxEntry>& outbox = _outbox.GetUnacknowledged();
    const auto oldest =
        std::ranges::find_if_not(outbox, [this](const OutboxEntry& entry) { return _backlog.IsHeldBack(entry); });
    OutboxSummary summary{outbox.size() - _backlog.CountHeldBack(), std::nullopt};
    if (oldest != outbox.end())
    {
        summary.oldest = oldest->time;
    }
    return summary;
}

std::vector<RobotStatus> PlanEngine::Impl::GetRobotStatuses() const
{
    std::vector<RobotStatus> statuses;
    statuses.reserve(_robots.size());
    for (const Robot& robot : _robots)
    {
        statuses.push_back(robot.lastStatus);
    }
    return statuses;
}

std::vector<RobotPose> PlanEngine::Impl::GetRobotPoses() const
{
    std::vector<RobotPose> poses;
    for (const Robot& robot : _robots)
    {
        if (robot.state.has_value() && robot.state->bPoseKnown)
        {
            const StateChanged& state = *robot.state;
            poses.push_back({GetRobotID(robot), state.x, state.y, state.theta, state.batteryPercent});
        }
    }
    return poses;
}

std::vector<PlanSummary> PlanEngine::Impl::GetActivePlans() const
{
    const auto rank = [](const ActivePlan* plan) {
        const EPlanState state = plan->record.progress.state;
        return state == EPlanState::InProgress ? 0 : (state == EPlanState::Paused ? 1 : 2);
    };
    std::vector<const ActivePlan*> ordered;
    ordered.reserve(_plans.GetActive().size());
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        ordered.push_back(plan.get());
    }
    std::ranges::sort(ordered, [&rank](const ActivePlan* left, const ActivePlan* right) {
        return std::pair(rank(left), left->key) < std::pair(rank(right), right->key);
    });
    std::vector<PlanSummary> summaries;
    summaries.reserve(ordered.size());
    for (const ActivePlan* plan : ordered)
    {
        summaries.push_back(MakeSummary(plan->record));
    }
    return summaries;
}

std::optional<PlanSummary> PlanEngine::Impl::GetPlanOrNull(std::string_view planID) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(planID);
    return recordOrNull == nullptr ? std::nullopt : std::optional(MakeSummary(*recordOrNull));
}

const std::vector<Alarm>& PlanEngine::Impl::GetActiveAlarms() const noexcept
{
    return _alarms.GetAlarms();
}

/// Section 5.2: Paused until the first consistency check is done.
ETscState PlanEngine::Impl::GetTscState() const noexcept
{
    return _startup.IsHoldingWork() && _tscState == ETscState::Auto ? ETscState::Paused : _tscState;
}

} // namespace ACS::Planning

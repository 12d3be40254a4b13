#include "engine/PlanEngine.Impl.hpp"
#include <acs/plan/PlanSummaries.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <functional>
#include <iterator>
#include <utility>

// What the engine shows of its state.

namespace ACS::Planning
{

namespace
{

/// The node to which the robot is on the way; nullopt if it is on its node, or if that is not known.
std::optional<std::string> FindNextNodeOrNull(const Robot& robot, const SiteMap& site)
{
    if (!robot.drive.has_value())
    {
        return robot.place.heading.has_value() ? std::optional(site.GetNodes()[*robot.place.heading].nodeID)
                                               : std::nullopt;
    }
    const ActiveDrive& drive = *robot.drive;
    if (!drive.bTaken || !robot.view.state.has_value() || drive.passed + 1 >= drive.nodes.size())
    {
        return std::nullopt;
    }
    const StateChanged& state = *robot.view.state;
    const RouteNode& own = drive.route.nodes[drive.passed];
    const bool bOnNode =
        state.bPoseKnown ? std::hypot(state.x - own.x, state.y - own.y) <= own.allowedDeviation : !state.bDriving;
    return bOnNode ? std::nullopt : std::optional(drive.GetNextNodeID());
}

} // namespace

std::vector<OutboxEntry> PlanEngine::GetUnacknowledged() const
{
    std::vector<OutboxEntry> entries;
    std::ranges::copy_if(
        _impl->_engine.outbox.GetUnacknowledged(),
        std::back_inserter(entries),
        [this](const OutboxEntry& entry) { return !_impl->_engine.backlog.IsHeldBack(entry); });
    return entries;
}

OutboxSummary PlanEngine::GetOutboxSummary() const
{
    const std::deque<OutboxEntry>& outbox = _impl->_engine.outbox.GetUnacknowledged();
    const auto oldest = std::ranges::find_if_not(outbox, [this](const OutboxEntry& entry) {
        return _impl->_engine.backlog.IsHeldBack(entry);
    });
    OutboxSummary summary{outbox.size() - _impl->_engine.backlog.CountHeldBack(), std::nullopt};
    if (oldest != outbox.end())
    {
        summary.oldest = oldest->time;
    }
    return summary;
}

std::vector<RobotPose> PlanEngine::GetRobotPoses() const
{
    std::vector<RobotPose> poses;
    for (const Robot& robot : _impl->_engine.fleet)
    {
        if (robot.view.state.has_value() && robot.view.state->bPoseKnown)
        {
            const StateChanged& state = *robot.view.state;
            poses.push_back({robot.GetID(), state.x, state.y, state.theta, state.batteryPercent});
        }
    }
    return poses;
}

std::vector<RobotDetail> PlanEngine::GetRobotDetails() const
{
    std::vector<RobotDetail> details;
    for (const Robot& robot : _impl->_engine.fleet)
    {
        RobotDetail& made = details.emplace_back();
        made.robotID = robot.GetID();
        made.bHasDrive = robot.drive.has_value();
        made.bHasJob = robot.job.GetOrNull() != nullptr;
        if (robot.place.bPlaced && robot.place.node.has_value())
        {
            made.nodeID = _impl->_engine.site.GetNodes()[*robot.place.node].nodeID;
            made.nextNodeID = FindNextNodeOrNull(robot, _impl->_engine.site);
        }
    }
    return details;
}

std::vector<RobotRoute> PlanEngine::GetRobotRoutes() const
{
    const std::vector<SiteNode>& nodes = _impl->_engine.site.GetNodes();
    const Traffic& traffic = _impl->_places.GetTraffic();
    std::vector<RobotRoute> routes;
    routes.reserve(_impl->_engine.fleet.size());
    for (const Robot& robot : _impl->_engine.fleet)
    {
        RobotRoute& made = routes.emplace_back();
        made.robotID = robot.GetID();
        for (const std::size_t node : traffic.ListReserved(robot.index))
        {
            made.reservedNodeIDs.push_back(nodes[node].nodeID);
        }
        const std::size_t end = robot.drive.has_value() ? robot.drive->nodes.size() : 0;
        for (std::size_t i = end == 0 ? 0 : robot.drive->passed + 1; i < end; ++i)
        {
            made.nodes.push_back({nodes[robot.drive->nodes[i]].nodeID, i < robot.drive->grantedCount});
        }
    }
    return routes;
}

std::vector<std::reference_wrapper<const PlanRecord>> PlanEngine::GetActivePlanRecords() const
{
    const auto rank = [](const ActivePlan* planOrNull) {
        const EPlanState state = planOrNull->record.progress.state;
        return state == EPlanState::InProgress ? 0 : (state == EPlanState::Paused ? 1 : 2);
    };
    std::vector<const ActivePlan*> ordered;
    ordered.reserve(_impl->_engine.plans.GetActive().size());
    for (const auto& [planID, plan] : _impl->_engine.plans.GetActive())
    {
        if (!IsStoring() || _impl->_engine.plans.IsOfEarlierCall(*plan))
        {
            ordered.push_back(plan.get());
        }
    }
    std::ranges::sort(ordered, [&rank](const ActivePlan* leftOrNull, const ActivePlan* rightOrNull) {
        return std::pair(rank(leftOrNull), leftOrNull->key) < std::pair(rank(rightOrNull), rightOrNull->key);
    });
    std::vector<std::reference_wrapper<const PlanRecord>> records;
    records.reserve(ordered.size());
    for (const ActivePlan* plan : ordered)
    {
        records.emplace_back(plan->record);
    }
    return records;
}

std::vector<std::reference_wrapper<const PlanRecord>> PlanEngine::GetFinishedPlanRecords(std::size_t limit) const
{
    return _impl->_engine.plans.ListFinished(limit);
}

std::vector<PlanSummary> PlanEngine::GetActivePlans() const
{
    std::vector<PlanSummary> summaries;
    for (const PlanRecord& record : GetActivePlanRecords())
    {
        summaries.push_back(MakeSummary(record));
    }
    return summaries;
}

const PlanRecord* PlanEngine::GetPlanRecordOrNull(std::string_view planID) const
{
    return _impl->_engine.plans.FindRecordOrNull(planID);
}

std::optional<PlanSummary> PlanEngine::GetPlanOrNull(std::string_view planID) const
{
    const PlanRecord* recordOrNull = _impl->_engine.plans.FindRecordOrNull(planID);
    return recordOrNull == nullptr ? std::nullopt : std::optional(MakeSummary(*recordOrNull));
}

std::vector<RobotStatus> PlanEngine::GetRobotStatuses() const
{
    return _impl->_status.GetRobotStatuses();
}

std::vector<WaitReason> PlanEngine::GetWaitReasons() const
{
    return _impl->_waits.GetReasons().GetWaitReasons();
}

std::optional<WaitReason> PlanEngine::GetWaitReasonOrNull(std::string_view planID) const
{
    return _impl->_waits.GetReasons().GetWaitReasonOrNull(planID);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SetCarriers& command) const
{
    return _impl->_operator.GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const ResolveJob& command) const
{
    return _impl->_operator.GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SkipStep& command) const
{
    return _impl->_operator.GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const ControlPlan& command) const
{
    return _impl->_controls.GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SetPlanPriority& command) const
{
    return _impl->_operator.GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const BlockPlace& command) const
{
    return _impl->_operator.GetBlocks().GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const UnblockPlace& command) const
{
    return _impl->_operator.GetBlocks().GetRejectionReasonOrNull(command);
}

const std::vector<Alarm>& PlanEngine::GetActiveAlarms() const noexcept
{
    return _impl->_engine.alarms.GetAlarms();
}

const std::vector<Block>& PlanEngine::GetBlocks() const noexcept
{
    return _impl->_engine.blocks.GetBlocks();
}

const EngineOptions& PlanEngine::GetOptions() const noexcept
{
    return _impl->_engine.options;
}

const SiteMap& PlanEngine::GetSite() const noexcept
{
    return _impl->_engine.site;
}

const std::string& PlanEngine::GetHoldReason() const noexcept
{
    return _impl->_engine.hold.GetReason();
}

std::string_view PlanEngine::GetTscReason() const noexcept
{
    return _impl->_tsc.GetReason();
}

ETscState PlanEngine::GetTscState() const noexcept
{
    return _impl->_tsc.GetTscState();
}

} // namespace ACS::Planning

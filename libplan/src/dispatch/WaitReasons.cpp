#include "dispatch/WaitReasons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

namespace
{

std::string DescribePause(const ActivePlan& plan)
{
    const bool bByOperator = plan.record.progress.controlOrigin == EControlOrigin::Operator;
    return plan.robot.has_value()
        ? fmt::format("The plan is paused{}.", bByOperator ? " by the operator" : "")
        : fmt::format("The plan is held in the queue by {}.", bByOperator ? "the operator" : "PausePlan");
}

} // namespace

WaitReasons::WaitReasons(
    EngineState& engine,
    const TscControl& tsc,
    const StallWatch& stalls,
    const WaitingRobots& waiting,
    const TrafficCoordinator& coordinator,
    const Dispatcher& dispatcher)
    : _options(engine.options),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _blocks(engine.blocks),
      _backlog(engine.backlog),
      _startup(engine.startup),
      _hold(engine.hold),
      _tsc(tsc),
      _stalls(stalls),
      _waiting(waiting),
      _coordinator(coordinator),
      _dispatcher(dispatcher)
{
}

std::vector<WaitReason> WaitReasons::GetWaitReasons() const
{
    std::vector<WaitReason> reasons;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (std::optional<WaitReason> reason = DescribeBegunOrNull(*plan))
        {
            reasons.push_back(std::move(*reason));
        }
    }
    std::size_t position = 0;
    std::size_t listed = 0;
    const StationForecast stations(_fleet, _coordinator.GetVisits());
    FirstPlans firstPlans;
    for (const auto& [key, plan] : _plans.GetQueue())
    {
        ++position;
        WaitReason reason;
        reason.planID = plan->record.plan.planID;
        reason.queuePosition = position;
        bool bCanStart = false; // beyond the limit: the dispatcher has found no robot that can start it
        if (listed < MAXIMUM_LISTED_ROBOTS)
        {
            reason.robots = ListUnavailable(*plan);
            listed += plan->resolved.candidates.size();
            bCanStart = reason.robots.size() < plan->resolved.candidates.size();
        }
        reason.message = DescribeWaiting(*plan, bCanStart, stations, firstPlans);
        reasons.push_back(std::move(reason));
        AddStations(*plan, firstPlans);
    }
    return reasons;
}

std::optional<WaitReason> WaitReasons::GetWaitReasonOrNull(std::string_view planID) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(planID);
    if (planOrNull == nullptr)
    {
        return std::nullopt;
    }
    const PlanBook::Queue& queue = _plans.GetQueue();
    const auto queued = queue.find(planOrNull->key);
    if (queued == queue.end())
    {
        return DescribeBegunOrNull(*planOrNull);
    }
    WaitReason reason;
    reason.planID = planOrNull->record.plan.planID;
    reason.queuePosition = static_cast<std::size_t>(std::distance(queue.begin(), queued)) + 1;
    reason.robots = ListUnavailable(*planOrNull);
    FirstPlans firstPlans;
    std::for_each(queue.begin(), queued, [&firstPlans](const auto& entry) { AddStations(*entry.second, firstPlans); });
    reason.message = DescribeWaiting(
        *planOrNull,
        reason.robots.size() < planOrNull->resolved.candidates.size(),
        StationForecast(_fleet, _coordinator.GetVisits()),
        firstPlans);
    return reason;
}

void WaitReasons::AddStations(const ActivePlan& plan, FirstPlans& firstPlans)
{
    for (const ResolvedStep& step : plan.resolved.steps)
    {
        firstPlans.try_emplace(step.stationID, &plan);
    }
}

std::optional<std::string> WaitReasons::DescribeUnavailabilityOrNull(const ActivePlan& plan, const Robot& robot) const
{
    if (!robot.view.bOnline)
    {
        return DescribeUnfree(robot);
    }
    if (std::optional<std::string> rejection = Dispatcher::DescribeRejectionOrNull(plan, robot))
    {
        return rejection;
    }
    if (!robot.IsFree())
    {
        return DescribeUnfree(robot);
    }
    if (std::optional<std::string> reason = _dispatcher.GetPorts().JudgePorts(plan, robot).unavailabilityOrNull)
    {
        return reason;
    }
    if (!_dispatcher.HasWay(plan, robot))
    {
        return "no route to " + plan.resolved.steps.front().stationID;
    }
    if (std::optional<std::string> reason = _coordinator.DescribeBlockOrNull(robot, plan))
    {
        return reason;
    }
    if (!_coordinator.CanServe(robot, plan))
    {
        return "robots that cannot move block the route to the station, or from there to its parking position";
    }
    if (const ActivePlan* keeperOrNull = _dispatcher.FindKeeperOrNull(plan, robot); keeperOrNull != nullptr)
    {
        return fmt::format("kept for plan {}, which is before it in the queue", keeperOrNull->record.plan.planID);
    }
    return std::nullopt;
}

std::string WaitReasons::DescribeHold() const
{
    return fmt::format("The TSC is Paused: {}", _hold.GetReason());
}

std::vector<RobotUnavailability> WaitReasons::ListUnavailable(const ActivePlan& plan) const
{
    std::vector<RobotUnavailability> robots;
    for (const std::size_t index : plan.resolved.candidates)
    {
        if (std::optional<std::string> reason = DescribeUnavailabilityOrNull(plan, _fleet[index]))
        {
            robots.push_back({_fleet[index].GetID(), std::move(*reason)});
        }
    }
    return robots;
}

std::string WaitReasons::DescribeWaiting(
    const ActivePlan& plan,
    bool bCanStart,
    const StationForecast& stations,
    const FirstPlans& firstPlans) const
{
    if (_hold.IsActive())
    {
        return DescribeHold();
    }
    if (_tsc.GetState() != ETscState::Auto)
    {
        return fmt::format("The TSC is {}: no plan is started.", GetText(_tsc.GetState()));
    }
    if (_backlog.IsFailing())
    {
        return "The store is failing: no plan is started until it works again.";
    }
    if (_startup.IsHoldingWork())
    {
        return StartupBarrier::REASON;
    }
    if (const Block* blockOrNull = FindBlockOrNull(plan); blockOrNull != nullptr)
    {
        return fmt::format("The {}.", BlockBook::Describe(*blockOrNull));
    }
    if (_dispatcher.IsRejectedByAll(plan))
    {
        return _dispatcher.DescribeRejections(plan);
    }
    return bCanStart ? DescribeStart(plan, stations, firstPlans) : "No suitable robot is free.";
}

std::string WaitReasons::DescribeStart(
    const ActivePlan& plan,
    const StationForecast& stations,
    const FirstPlans& firstPlans) const
{
    if (const std::optional<std::string_view> taken = stations.FindTakenOrNull(plan); taken.has_value())
    {
        const Robot& robot = _fleet[stations.ListRobots(*taken).front()];
        return fmt::format(
            "{} uses station {} for plan {}. The plan starts when it can arrive there afterwards.",
            robot.GetID(),
            *taken,
            robot.planOrNull->record.plan.planID);
    }
    for (const ResolvedStep& step : plan.resolved.steps)
    {
        if (const auto first = firstPlans.find(step.stationID); first != firstPlans.end())
        {
            return fmt::format(
                "Plan {} is before it in the queue and uses station {} too.",
                first->second->record.plan.planID,
                step.stationID);
        }
    }
    return "The plan is about to start.";
}

const Block* WaitReasons::FindBlockOrNull(const ActivePlan& plan) const
{
    for (const ResolvedStep& step : plan.resolved.steps)
    {
        if (const Block* blockOrNull = _blocks.FindOrNull(EBlockKind::Station, step.stationID); blockOrNull != nullptr)
        {
            return blockOrNull;
        }
    }
    return nullptr;
}

std::optional<WaitReason> WaitReasons::DescribeBegunOrNull(const ActivePlan& plan) const
{
    WaitReason reason;
    reason.planID = plan.record.plan.planID;
    if (plan.record.progress.state == EPlanState::Paused)
    {
        reason.message = DescribePause(plan);
        return reason;
    }
    if (!plan.robot.has_value())
    {
        return std::nullopt;
    }
    const Robot& robot = _fleet[*plan.robot];
    if (_hold.IsActive() && !robot.job.IsUnresolved())
    {
        reason.message = DescribeHold();
        return reason;
    }
    if (const EUnavailability unavailability = robot.GetUnavailability(); unavailability != EUnavailability::None)
    {
        reason.message = fmt::format("{}: {}.", robot.GetID(), robot.Describe(unavailability));
        return reason;
    }
    if (robot.activity == EActivity::Works && robot.job.IsUnresolved())
    {
        reason.message =
            fmt::format("Outcome of job {} unknown. Check {}, then resolve the job.", GetJobID(plan), robot.GetID());
        return reason;
    }
    if (plan.bUnstored)
    {
        reason.message = "The store is failing: the start of the plan is not stored yet.";
        return reason;
    }
    if (_stalls.IsStalled(robot))
    {
        reason.message = fmt::format("{} stalled: {}. Check the robot.", robot.GetID(), _stalls.DescribeStall(robot));
        return reason;
    }
    if (robot.activity == EActivity::Waits && _waiting.IsAtPlace(robot))
    {
        const std::optional<std::string> objection = PortCheck::DescribeMissingTrayOrNull(robot);
        reason.message = objection.has_value()
            ? fmt::format("{}: load the tray by hand, then correct the record of the robot's ports.", *objection)
            : robot.GetID() + " is about to start the job.";
        return reason;
    }
    const bool bAtBaseEnd = robot.drive.has_value() && !robot.view.state->bDriving && robot.drive->IsAtBaseEnd();
    if (robot.activity != EActivity::Waits || (robot.drive.has_value() && !bAtBaseEnd))
    {
        return std::nullopt;
    }
    reason.message = DescribeStanding(robot);
    return reason;
}

std::string WaitReasons::DescribeIdle(const Robot& robot) const
{
    if (robot.parking.bRefused && !robot.drive.has_value() && !robot.place.IsOn(robot.parking.GetHomeOrNull()))
    {
        const std::string& text = robot.parking.refusal;
        return text.ends_with('.') ? text : text + '.';
    }
    const bool bDriving = robot.drive.has_value() && (robot.view.state->bDriving || !robot.drive->IsAtBaseEnd());
    const bool bBlocked = !robot.search.block.empty() || !robot.search.blockers.empty();
    return bBlocked && !bDriving && _waiting.IsWaiting(robot) ? DescribeStanding(robot) : std::string();
}

std::string WaitReasons::DescribeStanding(const Robot& robot) const
{
    if (!robot.search.block.empty())
    {
        return fmt::format("{} waits: {}.", robot.GetID(), robot.search.block);
    }
    std::string holders;
    for (const std::size_t blocker : robot.search.blockers)
    {
        holders += (holders.empty() ? "" : " and ") + _fleet[blocker].GetID();
    }
    if (robot.drive.has_value())
    {
        const std::size_t next = robot.drive->releasedCount;
        if (!holders.empty())
        {
            const bool bTaken = _waiting.IsTaken(robot.drive->nodes[next], robot);
            holders.insert(0, bTaken ? ", blocked by " : ": there it could close the way of ");
        }
        return fmt::format(
            "{} waits for node {} on its route{}.",
            robot.GetID(),
            robot.drive->route.nodes[next].nodeID,
            holders);
    }
    if (holders.empty())
    {
        return robot.GetID() + " is about to drive.";
    }
    return fmt::format("{} waits for {} to clear its route.", robot.GetID(), holders);
}

std::string WaitReasons::DescribeUnfree(const Robot& robot) const
{
    if (const EUnavailability unavailability = robot.GetUnavailability(); unavailability != EUnavailability::None)
    {
        return robot.Describe(unavailability);
    }
    if (robot.planOrNull != nullptr)
    {
        return "busy with plan " + robot.planOrNull->record.plan.planID;
    }
    if (robot.charging.IsBatteryLow())
    {
        const double percent = robot.view.state->batteryPercent;
        const DispatchOptions& dispatch = _options.dispatch;
        return percent < dispatch.batteryFloor
            ? fmt::format("battery {:.0f} % is below {:.0f} %", percent, dispatch.batteryFloor)
            : fmt::format("charging, battery {:.0f} % of {:.0f} %", percent, dispatch.batteryResume);
    }
    return robot.IsStopping() ? "is coming to a stop" : "drives to " + robot.drive->route.nodes.back().nodeID;
}

} // namespace ACS::Planning

#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace ACS::Planning
{

/// The first that holds, but for having other work.
PlanEngine::Impl::EUnavailability PlanEngine::Impl::GetUnavailability(const Robot& robot)
{
    if (!robot.bOnline)
    {
        return EUnavailability::Link;
    }
    if (!robot.state.has_value() || !robot.bPlaced || !robot.node.has_value())
    {
        return EUnavailability::Place;
    }
    // It ends its plan first, and a drive home.
    if (robot.bInMaintenance && robot.planOrNull == nullptr && !robot.drive.has_value())
    {
        return EUnavailability::Maintenance;
    }
    const StateChanged& state = *robot.state;
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
    if (state.bPaused || IsHeld(robot))
    {
        return EUnavailability::Paused;
    }
    if (!state.bAutomatic)
    {
        return EUnavailability::Manual;
    }
    const bool bOccupied = state.bOccupied || robot.bStandstillAwaited || robot.job.IsOverdue();
    return bOccupied ? EUnavailability::Occupied : EUnavailability::None;
}

std::string PlanEngine::Impl::Describe(const Robot& robot, EUnavailability unavailability)
{
    switch (unavailability)
    {
        case EUnavailability::None:
            return {};
        case EUnavailability::Link:
            return "no connection";
        case EUnavailability::Place:
            return "its place is not known";
        case EUnavailability::Maintenance:
            return "in maintenance";
        case EUnavailability::Error:
        {
            const std::vector<RobotError>& errors = robot.state->errors;
            return "error " + std::ranges::find(errors, EAlarmLevel::Heavy, &RobotError::level)->errorCode;
        }
        case EUnavailability::SafetyStop:
            return "emergency or protective stop";
        case EUnavailability::Paused:
            return "paused";
        case EUnavailability::Manual:
            return "not in automatic mode";
        case EUnavailability::Occupied:
            return "busy with work that is no part of a plan any more";
        default:
            return "cannot be used";
    }
}

bool PlanEngine::Impl::IsUsable(const Robot& robot)
{
    return GetUnavailability(robot) == EUnavailability::None;
}

/// Whether it may be given a plan, as far as the robot itself goes.
bool PlanEngine::Impl::IsFree(const Robot& robot)
{
    return robot.planOrNull == nullptr && !robot.drive.has_value() && !robot.charging.IsBatteryLow() && IsUsable(robot);
}

std::string PlanEngine::Impl::DescribeUnfree(const Robot& robot) const
{
    if (const EUnavailability unavailability = GetUnavailability(robot); unavailability != EUnavailability::None)
    {
        return Describe(robot, unavailability);
    }
    if (robot.planOrNull != nullptr)
    {
        return "busy with plan " + robot.planOrNull->record.plan.planID;
    }
    if (robot.charging.IsBatteryLow())
    {
        const double percent = robot.state->batteryPercent;
        const DispatchOptions& dispatch = _options.dispatch;
        return percent < dispatch.batteryFloor
            ? fmt::format("battery {:.0f} % is below {:.0f} %", percent, dispatch.batteryFloor)
            : fmt::format("charges, battery {:.0f} % of {:.0f} %", percent, dispatch.batteryResume);
    }
    return "drives to " + robot.drive->route.nodes.back().nodeID;
}

void PlanEngine::Impl::AssignPlans()
{
    for (ActivePlan* plan : _plans.ListStoredQueue())
    {
        if (std::ranges::none_of(_robots, IsFree))
        {
            return;
        }
        if (Robot* robotOrNull = FindNearestOrNull(*plan); robotOrNull != nullptr)
        {
            BeginPlan(*plan, *robotOrNull);
        }
    }
}

/// To the plan's first place. By the times that the router keeps for it: the whole route of each robot would be searched
/// for nothing.
bool PlanEngine::Impl::HasWay(const ActivePlan& plan, const Robot& robot) const
{
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
    const std::array start{*robot.node};
    return _router.FindQuickestStartOrNull(vehicleTypeID, start, dock).has_value();
}

/// Of these, the one with the shortest way to the plan's first place; null where none has a way.
PlanEngine::Impl::Robot* PlanEngine::Impl::FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots)
    const
{
    // One search for each vehicle type, however many robots of it there are.
    std::map<std::string_view, std::vector<std::size_t>> starts;
    for (const Robot* robot : robots)
    {
        starts[robot->options->vehicleTypeID].push_back(*robot->node);
    }
    std::optional<QuickestStart> quickest;
    for (const auto& [vehicleTypeID, nodes] : starts)
    {
        const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
        const std::optional<QuickestStart> start = _router.FindQuickestStartOrNull(vehicleTypeID, nodes, dock);
        if (start.has_value() && (!quickest.has_value() || start->travelSeconds < quickest->travelSeconds))
        {
            quickest = start;
        }
    }
    const auto nearest = std::ranges::find_if(robots, [&quickest](const Robot* robot) {
        return quickest.has_value() && robot->node == quickest->nodeIndex;
    });
    return nearest == robots.end() ? nullptr : *nearest;
}

/// Of the robots that are free, can do the jobs and whose ports fit, the nearest; one that is known to have the carriers
/// before one of which that is only supposed.
PlanEngine::Impl::Robot* PlanEngine::Impl::FindNearestOrNull(const ActivePlan& plan)
{
    std::vector<Robot*> known;
    std::vector<Robot*> supposed;
    for (const std::size_t index : plan.resolved.candidates)
    {
        Robot& robot = _robots[index];
        const bool bPossible = IsFree(robot) && !plan.rejections.contains(index);
        const PortVerdict verdict = bPossible ? JudgePorts(plan, robot) : PortVerdict{"", false};
        if (!verdict.unavailabilityOrNull.has_value() && CanServe(robot, plan))
        {
            (verdict.bSupposed ? supposed : known).push_back(&robot);
        }
    }
    const bool bAll = known.size() + supposed.size() == plan.resolved.candidates.size();
    if (bAll && plan.resolved.candidates.size() == 1)
    {
        return &_robots[plan.resolved.candidates.front()];
    }
    for (const std::vector<Robot*>& robots : {known, supposed})
    {
        if (Robot* quickestOrNull = FindQuickestOrNull(plan, robots); quickestOrNull != nullptr)
        {
            return quickestOrNull;
        }
    }
    // With no robot to wait for, the drive starts anyway and fails because there is no route.
    return bAll ? &_robots[plan.resolved.candidates.front()] : nullptr;
}

/// Which of the robot's carrier ports the place is; nullopt where it is none.
std::optional<std::size_t> PlanEngine::Impl::FindPortOrNull(
    const Robot& robot,
    const std::optional<Core::Location>& place) const
{
    if (!place.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> port = place->WithRobot(_options.robots[robot.index].robotID);
    return port.has_value() ? robot.ports.FindPortOrNull(port->GetText()) : std::nullopt;
}

/// The plan's first load or unload of each port, checked against what the robot is known to have there, and the trays that
/// its memory jobs need. What a plan does to a port afterwards is its own affair: if it is wrong, no other robot does it
/// better.
PlanEngine::Impl::PortVerdict PlanEngine::Impl::JudgePorts(const ActivePlan& plan, const Robot& robot) const
{
    PortVerdict verdict;
    PortLedger::Contents planned;
    for (std::size_t step = 0; step < plan.resolved.steps.size(); ++step)
    {
        const std::vector<std::string>& carrierIDs = plan.record.plan.steps[step].carrierIDs;
        for (std::size_t job = 0; job < plan.resolved.steps[step].jobs.size(); ++job)
        {
            JudgeJob(
                robot,
                plan.resolved.steps[step],
                job,
                job < carrierIDs.size() ? carrierIDs[job] : std::string(),
                planned,
                verdict);
            if (verdict.unavailabilityOrNull.has_value())
            {
                return verdict;
            }
        }
    }
    return verdict;
}

void PlanEngine::Impl::JudgeJob(
    const Robot& robot,
    const ResolvedStep& step,
    std::size_t job,
    const std::string& carrierID,
    PortLedger::Contents& planned,
    PortVerdict& verdict) const
{
    const ResolvedJob& places = step.jobs[job];
    if (std::optional<std::string> objection = DescribeMissingTrayOrNull(robot, places, planned))
    {
        verdict.unavailabilityOrNull = std::move(objection);
        return;
    }
    for (const bool bFills : {false, true})
    {
        const std::optional<std::size_t> port = IsPortChanged(step.rule->effect, bFills)
            ? FindPortOrNull(robot, bFills ? places.to : places.from)
            : std::nullopt;
        if (!port.has_value() || !planned.insert_or_assign(*port, bFills).second)
        {
            continue;
        }
        verdict.bSupposed = verdict.bSupposed || (!bFills && !robot.ports.GetCarriers()[*port].has_value());
        verdict.unavailabilityOrNull =
            bFills ? DescribeLoadConflictOrNull(robot, *port) : DescribeUnloadConflictOrNull(robot, *port, carrierID);
        if (verdict.unavailabilityOrNull.has_value())
        {
            return;
        }
    }
}

/// A memory place on a robot is inside a tray: the tray must be on record on its port, or be loaded by a job before.
std::optional<std::string> PlanEngine::Impl::DescribeMissingTrayOrNull(
    const Robot& robot,
    const ResolvedJob& job,
    const PortLedger::Contents& planned)
{
    for (const std::optional<Core::Location>* place : {&job.from, &job.to})
    {
        const std::optional<std::size_t> port =
            place->has_value() ? robot.ports.FindMissingTrayOrNull(**place, planned) : std::nullopt;
        if (port.has_value())
        {
            const std::string& tray = robot.ports.GetName(*port);
            const std::string& memory = (*place)->GetText();
            return fmt::format("{} has no tray for {}{}", tray, tray, memory.substr(memory.rfind('.')));
        }
    }
    return std::nullopt;
}

/// Of the present job.
std::optional<std::string> PlanEngine::Impl::DescribeMissingTrayOrNull(const Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    return HasJob(plan) ? DescribeMissingTrayOrNull(robot, plan.resolved.steps[plan.step].jobs[plan.job], {})
                        : std::nullopt;
}

std::optional<std::string> PlanEngine::Impl::DescribeLoadConflictOrNull(const Robot& robot, std::size_t port) const
{
    const std::optional<std::string>& carrier = robot.ports.GetCarriers()[port];
    return carrier.has_value() && !_options.dispatch.bLoadsIntoTakenPorts
        ? std::optional(fmt::format("{} is taken by {}", robot.ports.GetName(port), *carrier))
        : std::nullopt;
}

/// A carrier is only where it is known to be. One that no robot is known to carry may have been loaded by hand.
std::optional<std::string> PlanEngine::Impl::DescribeUnloadConflictOrNull(
    const Robot& robot,
    std::size_t port,
    const std::string& carrierID) const
{
    const std::optional<std::string>& held = robot.ports.GetCarriers()[port];
    if (carrierID.empty() || held == carrierID)
    {
        return std::nullopt;
    }
    for (const Robot& other : _robots)
    {
        if (const std::optional<std::size_t> found = other.ports.FindCarrierOrNull(carrierID))
        {
            return fmt::format("{} is on {}", carrierID, other.ports.GetName(*found));
        }
    }
    if (held.has_value() && *held != UNKNOWN_CARRIER)
    {
        return fmt::format("{} holds {}, not {}", robot.ports.GetName(port), *held, carrierID);
    }
    return std::nullopt;
}

} // namespace ACS::Planning

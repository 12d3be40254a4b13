#include "dispatch/PortCheck.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

PortCheck::PortCheck(EngineState& engine)
    : _options(engine.options),
      _fleet(engine.fleet)
{
}

std::optional<std::size_t> PortCheck::FindPortOrNull(
    const Robot& robot,
    const std::optional<Core::Location>& placeOrNull) const
{
    if (!placeOrNull.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> port = placeOrNull->WithRobot(_options.robots[robot.index].robotID);
    return port.has_value() ? robot.ports.FindPortOrNull(port->GetText()) : std::nullopt;
}

PortVerdict PortCheck::JudgePorts(const ActivePlan& plan, const Robot& robot) const
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

void PortCheck::JudgeJob(
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

/// A memory place on a robot is inside a tray. The record must have the tray on its port, or an earlier job must load it.
std::optional<std::string> PortCheck::DescribeMissingTrayOrNull(
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
std::optional<std::string> PortCheck::DescribeMissingTrayOrNull(const Robot& robot)
{
    const ActivePlan& plan = *robot.planOrNull;
    return HasJob(plan) ? DescribeMissingTrayOrNull(robot, plan.resolved.steps[plan.step].jobs[plan.job], {})
                        : std::nullopt;
}

std::optional<std::string> PortCheck::DescribeLoadConflictOrNull(const Robot& robot, std::size_t port) const
{
    const std::optional<std::string>& carrier = robot.ports.GetCarriers()[port];
    return carrier.has_value() && !_options.dispatch.bLoadsIntoTakenPorts
        ? std::optional(fmt::format("{} is taken by {}", robot.ports.GetName(port), *carrier))
        : std::nullopt;
}

std::optional<std::string> PortCheck::DescribeUnloadConflictOrNull(
    const Robot& robot,
    std::size_t port,
    const std::string& carrierID) const
{
    const std::optional<std::string>& held = robot.ports.GetCarriers()[port];
    if (carrierID.empty() || held == carrierID)
    {
        return std::nullopt;
    }
    for (const Robot& other : _fleet)
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

#include "plan/PlanAdmission.hpp"

#include <acs/core/ECoreError.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

// Which robots can execute a plan.

namespace ACS::Planning
{

void PlanAdmission::FindClasses()
{
    using Key = std::tuple<ERobotType, std::string, RejectedActions, std::set<std::string>>;
    std::map<std::string, std::set<std::string>, std::less<>> ports; // by robot, without its name
    const auto note = [&ports](const Core::Location& place) {
        if (place.IsRobotPort())
        {
            ports[place.GetRobotOrNull()->GetText()].insert(place.GetText().substr(place.GetText().find('.')));
        }
    };
    std::ranges::for_each(_options.places, note);
    for (const RobotOptions& robot : _options.robots)
    {
        std::ranges::for_each(robot.ports, note);
        std::ranges::for_each(robot.childPorts, note);
    }
    std::map<Key, std::size_t> classes;
    for (std::size_t i = 0; i < _options.robots.size(); ++i)
    {
        const RobotOptions& robot = _options.robots[i];
        _robots.emplace(robot.robotID.GetText(), i);
        Key key(robot.type, robot.vehicleTypeID, robot.rejectedActions, ports[robot.robotID.GetText()]);
        const auto [entry, bNew] = classes.try_emplace(std::move(key), _classes.size());
        if (bNew)
        {
            _classes.emplace_back();
        }
        _classes[entry->second].push_back(i);
    }
}

Core::Result<void> PlanAdmission::FindCandidates(const Plan& plan, ResolvedPlan& resolved) const
{
    std::set<std::string> namedRobots;
    const auto note = [&namedRobots](const std::optional<Core::Location>& placeOrNull) {
        if (placeOrNull.has_value() && placeOrNull->IsRobotPort() && !placeOrNull->GetRobotOrNull()->IsAlias())
        {
            namedRobots.insert(placeOrNull->GetRobotOrNull()->GetText());
        }
    };
    for (const ResolvedStep& step : resolved.steps)
    {
        for (const ResolvedJob& job : step.jobs)
        {
            note(job.from);
            note(job.to);
        }
    }
    if (namedRobots.size() > 1)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidLocation),
            "steps",
            "ports of one robot",
            fmt::format("{} and {}", *namedRobots.begin(), *std::next(namedRobots.begin())));
    }
    resolved.candidates = ListCandidates(plan, resolved, namedRobots);
    if (!resolved.candidates.empty())
    {
        return {};
    }
    std::string objections;
    for (const RobotOptions& robot : _options.robots)
    {
        objections += objections.empty() ? "" : "; ";
        objections += GetRejectionReasonOrNull(robot, plan, resolved, namedRobots).value_or(std::string());
    }
    return Core::Fail(
        make_error_code(Core::ECoreError::InvalidLocation),
        "steps",
        "a plan that a robot of this site can execute",
        std::move(objections));
}

std::span<const std::size_t> PlanAdmission::ListCandidates(
    const Plan& plan,
    const ResolvedPlan& resolved,
    const std::set<std::string>& namedRobots) const
{
    const auto canExecute = [&](std::size_t robot) {
        return !GetRejectionReasonOrNull(_options.robots[robot], plan, resolved, namedRobots).has_value();
    };
    if (!namedRobots.empty())
    {
        const auto named = _robots.find(*namedRobots.begin());
        if (named == _robots.end() || !canExecute(named->second))
        {
            return {};
        }
        return _named.try_emplace(named->second, 1, named->second).first->second;
    }
    std::vector<bool> able;
    for (const std::vector<std::size_t>& robots : _classes)
    {
        able.push_back(canExecute(robots.front()));
    }
    const auto [entry, bNew] = _candidates.try_emplace(able);
    for (std::size_t i = 0; bNew && i < _classes.size(); ++i)
    {
        entry->second.insert(
            entry->second.end(),
            _classes[i].begin(),
            able[i] ? _classes[i].end() : _classes[i].begin());
    }
    std::ranges::sort(entry->second);
    return entry->second;
}

std::optional<std::string> PlanAdmission::GetRejectionReasonOrNull(
    const RobotOptions& robot,
    const Plan& plan,
    const ResolvedPlan& resolved,
    const std::set<std::string>& namedRobots) const
{
    const std::string& name = robot.robotID.GetText();
    if (!namedRobots.empty() && *namedRobots.begin() != name)
    {
        return name + " is not the robot named in the plan";
    }
    if (resolved.steps.front().rule->robotType != robot.type)
    {
        return fmt::format("{} is of type {}", name, GetText(robot.type));
    }
    const auto hasPort = [this, &robot](const std::optional<Core::Location>& placeOrNull) {
        if (!placeOrNull.has_value() || !placeOrNull->IsRobotPort())
        {
            return true;
        }
        const Core::Result<Core::Location> port = placeOrNull->WithRobot(robot.robotID);
        return port.has_value() && _catalog.Contains(*port);
    };
    for (std::size_t i = 0; i < resolved.steps.size(); ++i)
    {
        const ResolvedStep& step = resolved.steps[i];
        const auto rejected = robot.rejectedActions.find(plan.steps[i].action);
        if (rejected != robot.rejectedActions.end())
        {
            return fmt::format("{} cannot do {}: {}", name, rejected->first, rejected->second);
        }
        if (!FindDockOrNull(step.stationID, robot.vehicleTypeID).has_value())
        {
            return fmt::format("{} cannot drive to {}", name, step.stationID);
        }
        for (const ResolvedJob& job : step.jobs)
        {
            if (!hasPort(job.from) || !hasPort(job.to))
            {
                return fmt::format("{} has no {}", name, (hasPort(job.from) ? job.to : job.from)->GetOriginalText());
            }
        }
    }
    return std::nullopt;
}

} // namespace ACS::Planning

#include "plans/RobotNaming.hpp"

#include <acs/core/RobotID.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

using Protocol::ERobotType;

namespace
{

constexpr std::string_view CASSETTE = "Cassette";

bool IsAliasPort(std::string_view location)
{
    constexpr std::string_view ALIAS = Core::RobotID::ALIAS;
    return location.starts_with(ALIAS) && location.substr(ALIAS.size()).starts_with('.');
}

void NamePort(std::string& location, const std::string& robotID)
{
    if (IsAliasPort(location))
    {
        location.replace(0, Core::RobotID::ALIAS.size(), robotID);
    }
}

ERobotType GetNeededType(const Protocol::ExecutionPlan& plan)
{
    const bool bCassettes = std::any_of(plan.steps.begin(), plan.steps.end(), [](const Protocol::PlanStep& step) {
        return step.action.starts_with(CASSETTE);
    });
    return bCassettes ? ERobotType::Logistics : ERobotType::Control;
}

} // namespace

bool NeedsRobot(const Protocol::ExecutionPlan& plan)
{
    return std::any_of(plan.steps.begin(), plan.steps.end(), [](const Protocol::PlanStep& step) {
        return std::any_of(step.jobs.begin(), step.jobs.end(), [](const Protocol::PlanJob& job) {
            return IsAliasPort(job.from) || IsAliasPort(job.to);
        });
    });
}

std::optional<std::string> ChooseRobotOrNull(
    const Protocol::ExecutionPlan& plan,
    const RobotBoard& board,
    std::size_t turn)
{
    std::vector<std::string> able;
    for (const auto& [robotID, robot] : board.GetRobots())
    {
        if (robot.status.has_value() && robot.status->robotType == GetNeededType(plan))
        {
            able.push_back(robotID);
        }
    }
    return able.empty() ? std::nullopt : std::optional(able[turn % able.size()]);
}

void NameRobot(Protocol::ExecutionPlan& plan, const std::string& robotID)
{
    for (Protocol::PlanStep& step : plan.steps)
    {
        for (Protocol::PlanJob& job : step.jobs)
        {
            NamePort(job.from, robotID);
            NamePort(job.to, robotID);
        }
    }
}

} // namespace ACS::McsSim

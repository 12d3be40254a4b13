#include "drivers/RobotRunners.hpp"

#include <cassert>

namespace ACS::Acsd
{

RobotRunners::RobotRunners(
    const RobotRunner::Dependencies& dependencies,
    const std::vector<RobotLinkConfig>& links,
    const RobotRunner::EventHandler& handler)
{
    for (const RobotLinkConfig& link : links)
    {
        _robots.try_emplace(link.robotID, dependencies, link, handler);
    }
}

void RobotRunners::Start()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.Start();
    }
}

void RobotRunners::Stop()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.Stop();
    }
}

void RobotRunners::Handle(const Planning::CommandRobot& command)
{
    const auto found = _robots.find(command.robotID);
    assert(found != _robots.end());
    found->second.Handle(command.command);
}

void RobotRunners::UpdateMetrics()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.UpdateMetrics();
    }
}

DriverDetails RobotRunners::GetDetails(const std::string& robotID) const
{
    const auto found = _robots.find(robotID);
    assert(found != _robots.end());
    return found->second.GetDetails();
}

RobotRunner* RobotRunners::FindOrNull(std::string_view robotID)
{
    const auto found = _robots.find(robotID);
    return found == _robots.end() ? nullptr : &found->second;
}

} // namespace ACS::Acsd

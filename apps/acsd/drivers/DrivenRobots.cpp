#include "drivers/DrivenRobots.hpp"

namespace ACS::Acsd
{

DrivenRobots::DrivenRobots(
    const DrivenRobot::Dependencies& dependencies,
    const std::vector<RobotLinkConfig>& links,
    const DrivenRobot::EventHandler& handler)
{
    for (const RobotLinkConfig& link : links)
    {
        if (link.bDriven)
        {
            _robots.try_emplace(link.robotID, dependencies, link, handler);
        }
    }
}

void DrivenRobots::Start()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.Start();
    }
}

void DrivenRobots::Stop()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.Stop();
    }
}

bool DrivenRobots::TryHandle(const Planning::CommandRobot& command)
{
    const auto found = _robots.find(command.robotID);
    if (found == _robots.end())
    {
        return false;
    }
    found->second.Handle(command.command);
    return true;
}

void DrivenRobots::UpdateMetrics()
{
    for (auto& [robotID, robot] : _robots)
    {
        robot.UpdateMetrics();
    }
}

} // namespace ACS::Acsd

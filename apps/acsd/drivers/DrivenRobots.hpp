#pragma once

#include "config/AcsdConfig.hpp"
#include "drivers/DrivenRobot.hpp"
#include <acs/plan/EngineAction.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The robots of drivers that are not built in.
class DrivenRobots final
{
    std::map<std::string, DrivenRobot, std::less<>> _robots;

public:
    DrivenRobots(
        const DrivenRobot::Dependencies& dependencies,
        const std::vector<RobotLinkConfig>& links,
        const DrivenRobot::EventHandler& handler);
    DrivenRobots(const DrivenRobots&) = delete;
    DrivenRobots& operator=(const DrivenRobots&) = delete;
    ~DrivenRobots() = default;

    void Start();
    void Stop();

    /// Returns false if the command is for another robot.
    [[nodiscard]] bool TryHandle(const Planning::CommandRobot& command);
    void UpdateMetrics();
};

} // namespace ACS::Acsd

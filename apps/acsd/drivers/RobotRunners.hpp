#pragma once

#include "config/AcsdConfig.hpp"
#include "drivers/RobotRunner.hpp"
#include <acs/acsd/IRobot.hpp>
#include <acs/plan/EngineAction.hpp>

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// All robots of acsd.
class RobotRunners final
{
    std::map<std::string, RobotRunner, std::less<>> _robots;

public:
    RobotRunners(
        const RobotRunner::Dependencies& dependencies,
        const std::vector<RobotLinkConfig>& links,
        const RobotRunner::EventHandler& handler);
    RobotRunners(const RobotRunners&) = delete;
    RobotRunners& operator=(const RobotRunners&) = delete;
    ~RobotRunners() = default;

    void Start();
    void Stop();

    /// The robot is one of these.
    void Handle(const Planning::CommandRobot& command);
    void UpdateMetrics();

    /// Of one of these.
    [[nodiscard]] DriverDetails GetDetails(const std::string& robotID) const;

    /// For the instant actions of a robot; null: there is no such robot.
    [[nodiscard]] RobotRunner* FindOrNull(std::string_view robotID);
};

} // namespace ACS::Acsd

#pragma once

#include "robot/Robot.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <cstddef>

namespace ACS::Planning
{

/// The present job of the robot's plan.
[[nodiscard]] StartJob MakeStartJob(const Robot& robot);
/// As the plan has it. A step without jobs has one job, without places and without an id.
[[nodiscard]] StartJob MakeStartJob(
    const ActivePlan& plan,
    std::size_t stepIndex,
    std::size_t jobIndex,
    const Robot& robot);

} // namespace ACS::Planning

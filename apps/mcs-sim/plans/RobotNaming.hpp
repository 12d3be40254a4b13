#pragma once

#include "console/RobotBoard.hpp"
#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::McsSim
{

/// Whether a place in the plan is a port of whichever robot executes it (AMR.CP01).
[[nodiscard]] bool NeedsRobot(const Protocol::ExecutionPlan& plan);

/// A robot that can do the plan's actions: those with a cassette are a logistics robot's, all others a control robot's. The
/// turn chooses among several. Nullopt: the ACS has reported none.
[[nodiscard]] std::optional<std::string> ChooseRobotOrNull(
    const Protocol::ExecutionPlan& plan,
    const RobotBoard& board,
    std::size_t turn);

/// Names the ports of the robot by its id: AMR.CP01 becomes LR01.CP01.
void NameRobot(Protocol::ExecutionPlan& plan, const std::string& robotID);

} // namespace ACS::McsSim

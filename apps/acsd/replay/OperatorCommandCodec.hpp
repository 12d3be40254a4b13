#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/PlanCommand.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// JSON of a command of the operator.
[[nodiscard]] std::string EncodeCommand(const Planning::PlanCommand& command);

/// Reads what EncodeCommand wrote. Accepts any text.
[[nodiscard]] Core::Result<Planning::PlanCommand> DecodeCommand(std::string_view text);

/// Of the plan and the robot that the command is about; empty: none.
[[nodiscard]] std::string FindPlanID(const Planning::PlanCommand& command);
[[nodiscard]] std::string FindRobotID(const Planning::PlanCommand& command);

} // namespace ACS::Acsd

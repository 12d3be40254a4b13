#pragma once

#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <string>

namespace ACS::Simulation
{

/// One line for the trace.
[[nodiscard]] std::string Describe(const Planning::Report& report);
[[nodiscard]] std::string Describe(const Planning::RobotCommand& command);
[[nodiscard]] std::string Describe(const Planning::RobotEvent& event);

} // namespace ACS::Simulation

#pragma once

#include <acs/plan/RobotEvent.hpp>

#include <string>

namespace ACS::AdapterTest
{

/// "JobFailed of job-1 (the gripper is empty)", for findings.
[[nodiscard]] std::string DescribeEvent(const Planning::RobotEvent& event);

} // namespace ACS::AdapterTest

#pragma once

#include "robots/ArmInput.hpp"
#include "robots/JobMethods.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <tl/expected.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The inputs of the program that does the job. The error names the value that its relay cannot hold.
[[nodiscard]] tl::expected<std::vector<ArmInput>, std::string> MakeArmInputs(
    const JobMethods& methods,
    const Planning::StartJob& job);

} // namespace ACS::Acsd

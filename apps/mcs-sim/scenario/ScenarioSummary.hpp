#pragma once

#include "console/StyledLine.hpp"
#include "scenario/ScenarioSequence.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// The verdict of every expectation, and of every action that could not be done.
[[nodiscard]] StyledLines MakeScenarioTable(const std::vector<ScenarioResult>& results);

/// The very last line of a run with scenarios: "2 of 2 scenarios passed, 9 of 9 expectations held, 0 violations".
[[nodiscard]] std::string MakeScenarioLastLine(const std::vector<ScenarioResult>& results, std::size_t violations);

} // namespace ACS::McsSim

#pragma once

#include "scenario/Scenario.hpp"
#include <acs/core/Result.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// Reads the plan file that a scenario names, relative to the scenario's folder; the error is one sentence.
using PlanReader = std::function<tl::expected<PlannedPlan, std::string>(const std::string& path)>;

/// Reads the text of a scenario file. Every error names the place, what was expected and what is
/// there: a member that no step has, a plan that was not sent before, a payload that cannot be decoded.
[[nodiscard]] Core::Result<Scenario> ParseScenario(std::string_view text, const PlanReader& readPlan);

/// The same from the disk. The error is one sentence that names the file.
[[nodiscard]] tl::expected<Scenario, std::string> ReadScenarioFile(const std::string& path);

} // namespace ACS::McsSim

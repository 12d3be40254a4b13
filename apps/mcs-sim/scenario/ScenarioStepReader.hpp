#pragma once

#include "scenario/Placeholders.hpp"
#include "scenario/Scenario.hpp"
#include "scenario/ScenarioFile.hpp"
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>

#include <chrono>
#include <string>

namespace ACS::McsSim
{

/// What the steps of one file know of each other: a plan must have been sent before it is spoken of.
struct StepsContext
{
    const PlanReader& readPlan;
    std::chrono::milliseconds within;
    ScenarioNames names;
};

/// The step at this path of the file.
[[nodiscard]] Core::Result<ScenarioStep> ReadScenarioStep(
    StepsContext& context,
    const Json::Value& value,
    const std::string& path);

} // namespace ACS::McsSim

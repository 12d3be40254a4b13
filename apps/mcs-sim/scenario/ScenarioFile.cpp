#include "scenario/ScenarioFile.hpp"

#include "common/config/TextFile.hpp"
#include "plans/PlanFile.hpp"
#include "scenario/ObjectReader.hpp"
#include "scenario/ScenarioStepReader.hpp"
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

namespace ACS::McsSim
{

namespace
{

using Json::Value;

constexpr std::chrono::seconds DEFAULT_WITHIN{30};

std::string DescribeInvalidSteps(const Value* stepsOrNull)
{
    if (stepsOrNull == nullptr)
    {
        return "nothing";
    }
    return stepsOrNull->IsArray() ? "an empty array" : Json::ShortenForError(*stepsOrNull);
}

} // namespace

Core::Result<Scenario> ParseScenario(std::string_view text, const PlanReader& readPlan)
{
    Json::JsonDocument document;
    const Core::Result<const Value*> parsed = document.Parse(text, {});
    if (!parsed.has_value())
    {
        return tl::make_unexpected(parsed.error());
    }
    if (Json::HasDuplicateNames(**parsed))
    {
        return Core::Fail(Core::ECoreError::InvalidJSON, {}, "each member once", "a member that is named twice");
    }
    ObjectReader reader(**parsed, {});
    Scenario scenario;
    scenario.name = reader.TakeText("name");
    static_cast<void>(reader.TakeText("about", ""));
    scenario.within = reader.TakeDuration("within", DEFAULT_WITHIN);
    const Value* const stepsOrNull = reader.TakeOrNull("steps");
    if (stepsOrNull == nullptr || !stepsOrNull->IsArray() || stepsOrNull->Empty())
    {
        reader.Refuse("steps", "an array of one step or more", DescribeInvalidSteps(stepsOrNull));
    }
    Core::Result<void> finished = reader.Finish();
    if (!finished.has_value())
    {
        return tl::make_unexpected(std::move(finished.error()));
    }
    StepsContext context{readPlan, scenario.within, {}};
    for (const Value& value : stepsOrNull->GetArray())
    {
        Core::Result<ScenarioStep> step =
            ReadScenarioStep(context, value, fmt::format("steps[{}]", scenario.steps.size()));
        if (!step.has_value())
        {
            return tl::make_unexpected(std::move(step.error()));
        }
        scenario.steps.push_back(std::move(*step));
    }
    return scenario;
}

tl::expected<Scenario, std::string> ReadScenarioFile(const std::string& path)
{
    const tl::expected<std::string, std::string> content = Apps::ReadTextFile(path);
    if (!content.has_value())
    {
        return tl::make_unexpected("the scenario file " + path + " cannot be read: " + content.error());
    }
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    Core::Result<Scenario> scenario =
        ParseScenario(*content, [&folder](const std::string& file) { return ReadPlanFile((folder / file).string()); });
    if (!scenario.has_value())
    {
        return tl::make_unexpected("the scenario file " + path + ": " + Describe(scenario.error()));
    }
    return std::move(*scenario);
}

} // namespace ACS::McsSim

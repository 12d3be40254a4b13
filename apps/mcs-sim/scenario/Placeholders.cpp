#include "scenario/Placeholders.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view CARRIER = "carrier.";

bool IsNameCharacter(char character)
{
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z')
        || (character >= '0' && character <= '9') || character == '_' || character == '-';
}

bool IsPlaceholderLike(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char character) {
        return character == '.' || IsNameCharacter(character);
    });
}

/// From 1; 0: it is none.
std::size_t ReadNumber(std::string_view text)
{
    return Core::ParseNumberOrNull<std::size_t>(text).value_or(0);
}

/// "1": its first job; "carrier.1": its first carrier.
std::optional<std::string> ReadStepPartOrNull(const Protocol::PlanStep& step, std::string_view part)
{
    const bool bCarrier = part.starts_with(CARRIER);
    const std::size_t number = ReadNumber(bCarrier ? part.substr(CARRIER.size()) : part);
    const std::size_t count = bCarrier ? step.carrierIDs.size() : step.jobs.size();
    if (number == 0 || number > count)
    {
        return std::nullopt;
    }
    return bCarrier ? step.carrierIDs[number - 1] : step.jobs[number - 1].jobID;
}

std::optional<std::string> ReadPlanPartOrNull(const PlannedPlan& planned, std::string_view part)
{
    if (part == "transactionId")
    {
        return planned.transactionID;
    }
    const std::size_t point = part.find('.');
    if (point == std::string_view::npos)
    {
        return std::nullopt;
    }
    const std::size_t stepNo = ReadNumber(part.substr(0, point));
    const auto& steps = planned.plan.steps;
    const auto step = std::find_if(steps.begin(), steps.end(), [stepNo](const Protocol::PlanStep& candidate) {
        return std::cmp_equal(candidate.stepNo, stepNo);
    });
    return step == steps.end() ? std::nullopt : ReadStepPartOrNull(*step, part.substr(point + 1));
}

std::optional<std::string> ReadMessagePartOrNull(const FoundMessage& message, std::string_view part)
{
    if (part == "transactionId")
    {
        return message.transactionID;
    }
    return part == "timestamp" ? std::optional(message.timestamp) : std::nullopt;
}

std::optional<Core::Error> FindInTextOrNull(std::string_view text, const std::string& path, const ScenarioNames& names)
{
    for (std::size_t start = text.find('{'); start != std::string_view::npos; start = text.find('{', start + 1))
    {
        const std::size_t end = text.find('}', start);
        const std::string_view name = end == std::string_view::npos ? "" : text.substr(start + 1, end - start - 1);
        if (IsPlaceholderLike(name) && !ReadPlaceholderOrNull(names, name).has_value())
        {
            return Core::Error{
                Core::ECoreError::OutOfRange,
                path,
                "a placeholder of what a step before gave a name to (\"as\")",
                Core::QuoteForError(text.substr(start, end - start + 1))};
        }
    }
    return std::nullopt;
}

} // namespace

FoundMessage ReadFoundMessage(std::string_view text)
{
    FoundMessage envelope;
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> value = document.Parse(text, {});
    if (value.has_value() && (*value)->IsObject())
    {
        const auto read = [value](const char* name) {
            const auto member = (*value)->FindMember(name);
            return member != (*value)->MemberEnd() && member->value.IsString()
                ? std::string(member->value.GetString(), member->value.GetStringLength())
                : std::string();
        };
        envelope = {read("transactionId"), read("timestamp")};
    }
    return envelope;
}

bool IsScenarioName(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), IsNameCharacter);
}

std::optional<std::string> ReadPlaceholderOrNull(const ScenarioNames& names, std::string_view name)
{
    const std::size_t point = name.find('.');
    const auto found = names.find(name.substr(0, point));
    if (found == names.end())
    {
        return std::nullopt;
    }
    const std::string_view part = point == std::string_view::npos ? "" : name.substr(point + 1);
    const auto* const planOrNull = std::get_if<PlannedPlan>(&found->second);
    if (planOrNull == nullptr)
    {
        return ReadMessagePartOrNull(std::get<FoundMessage>(found->second), part);
    }
    return point == std::string_view::npos ? planOrNull->plan.planID : ReadPlanPartOrNull(*planOrNull, part);
}

// As deep as the parser's limit.
std::optional<Core::Error> FindBadPlaceholderOrNullRecursive( // NOLINT(misc-no-recursion)
    const Json::Value& value,
    const std::string& path,
    const ScenarioNames& names)
{
    std::optional<Core::Error> found;
    if (value.IsString())
    {
        found = FindInTextOrNull({value.GetString(), value.GetStringLength()}, path, names);
    }
    else if (value.IsObject())
    {
        for (auto member = value.MemberBegin(); member != value.MemberEnd() && !found.has_value(); ++member)
        {
            found = FindBadPlaceholderOrNullRecursive(
                member->value,
                fmt::format("{}.{}", path, member->name.GetString()),
                names);
        }
    }
    else if (value.IsArray())
    {
        for (rapidjson::SizeType i = 0; i < value.Size() && !found.has_value(); ++i)
        {
            found = FindBadPlaceholderOrNullRecursive(value[i], fmt::format("{}[{}]", path, i), names);
        }
    }
    return found;
}

} // namespace ACS::McsSim

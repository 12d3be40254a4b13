#include "ActionFault.hpp"

#include <acs/core/ParseNumber.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

/// A number, or a string that holds one: there are masters that write every value as a string.
std::optional<double> ReadNumberOrNull(const Core::JsonText& value)
{
    const std::optional<std::string> text = value.GetStringOrNull();
    if (!text.has_value())
    {
        return value.GetNumberOrNull();
    }
    const std::optional<double> number = Core::ParseNumberOrNull<double>(*text);
    return number.has_value() && std::isfinite(*number) ? number : std::nullopt;
}

/// The text as a number that states exactly what it states; nullopt for other texts.
std::optional<Core::JsonText> ParseNumberValueOrNull(std::string_view text, bool bWhole)
{
    constexpr double LARGEST_INTEGER = 9'007'199'254'740'992.0; // greater whole numbers are not exact as a double
    if (const std::optional<std::int64_t> integer = Core::ParseNumberOrNull<std::int64_t>(text); integer.has_value())
    {
        return Core::JsonText::FromInteger(*integer);
    }
    const std::optional<double> number = Core::ParseNumberOrNull<double>(text);
    if (!number.has_value() || !std::isfinite(*number))
    {
        return std::nullopt;
    }
    if (std::trunc(*number) == *number && std::abs(*number) <= LARGEST_INTEGER)
    {
        return Core::JsonText::FromInteger(static_cast<std::int64_t>(*number));
    }
    return bWhole ? std::nullopt : std::optional(Core::JsonText::FromNumber(*number));
}

std::optional<Core::JsonText> ParseValueOrNull(std::string_view text, EValueDataType type)
{
    switch (type)
    {
        case EValueDataType::Bool:
            return text == "true" || text == "false" ? std::optional(Core::JsonText::FromBoolean(text == "true"))
                                                     : std::nullopt;
        case EValueDataType::Number:
        case EValueDataType::Float:
        case EValueDataType::Integer:
            return ParseNumberValueOrNull(text, type == EValueDataType::Integer);
        case EValueDataType::String:
        case EValueDataType::Object:
        case EValueDataType::Array:
        default:
            return std::nullopt;
    }
}

bool IsOfType(const Core::JsonText& value, EValueDataType type, bool bTextTaken)
{
    if (!bTextTaken && value.GetText().starts_with('"'))
    {
        return type == EValueDataType::String;
    }
    const char first = value.GetText().empty() ? '\0' : value.GetText().front();
    switch (type)
    {
        case EValueDataType::Bool:
            return value.GetBooleanOrNull().has_value() || value.GetText() == R"("true")"
                || value.GetText() == R"("false")";
        case EValueDataType::Number:
        case EValueDataType::Float:
            return ReadNumberOrNull(value).has_value();
        case EValueDataType::Integer:
        {
            const std::optional<double> number = ReadNumberOrNull(value);
            return number.has_value() && std::trunc(*number) == *number;
        }
        case EValueDataType::String:
            return first == '"';
        case EValueDataType::Object:
            return first == '{';
        case EValueDataType::Array:
            return first == '[';
        default:
            return false;
    }
}

bool IsListed(const AgvAction& row, std::string_view key)
{
    return std::ranges::find(row.actionParameters, key, &AgvActionParameter::key) != row.actionParameters.end();
}

ActionFault MakeUnknownParameter(const Action& action, const std::string& key)
{
    return ActionFault{"the vehicle knows no parameter " + key + " of " + action.actionType, key};
}

/// The session evaluates the parameter, whether or not the factsheet lists it.
bool IsOfSession(const Action& action, std::string_view key)
{
    return action.actionType == ActionTypes::CANCEL_ORDER && key == "orderId";
}

std::optional<ActionFault> FindParameterFaultOrNull(
    const Action& action,
    const AgvAction& row,
    bool bClosed,
    EParameterCheck check)
{
    const bool bTextTaken = check != EParameterCheck::Strict;
    for (const AgvActionParameter& known : row.actionParameters)
    {
        const ActionParameter* given = FindParameterOrNull(action, known.key);
        if (given == nullptr && !known.bOptional.value_or(false))
        {
            return ActionFault{"the parameter " + known.key + " of " + action.actionType + " is missing", known.key};
        }
        if (given != nullptr && !IsOfType(given->value, known.valueDataType, bTextTaken))
        {
            return ActionFault{
                "the parameter " + known.key + " of " + action.actionType + " has the wrong type",
                known.key};
        }
    }
    for (const ActionParameter& given : action.actionParameters)
    {
        if (bClosed && !IsListed(row, given.key))
        {
            return MakeUnknownParameter(action, given.key);
        }
    }
    return std::nullopt;
}

/// A row without parameters has those of the standard.
const AgvAction& GetParameterRules(const AgvAction& row)
{
    const AgvAction* const predefined = FindPredefinedActionOrNull(row.actionType);
    return row.actionParameters.empty() && predefined != nullptr ? *predefined : row;
}

bool IsInScope(const AgvAction& row, EActionScope scope)
{
    return std::ranges::find(row.actionScopes, scope) != row.actionScopes.end();
}

/// Instant actions run beside everything: a master may send any blocking type with them.
bool IsBlockingTypeKnown(const AgvAction& row, const Action& action, EActionScope scope)
{
    return scope == EActionScope::Instant || row.blockingTypes.empty()
        || std::ranges::find(row.blockingTypes, action.blockingType) != row.blockingTypes.end();
}

} // namespace

std::optional<ActionFault> FindActionFaultOrNull(
    const FactsheetMessage& factsheet,
    const Action& action,
    EActionScope scope,
    EParameterCheck check)
{
    for (const ActionParameter& given : action.actionParameters)
    {
        if (given.value.GetText() == "null")
        {
            return ActionFault{"the parameter " + given.key + " of " + action.actionType + " is null", given.key};
        }
    }
    const std::vector<AgvAction>& listed = factsheet.protocolFeatures.agvActions;
    const AgvAction* predefined = FindPredefinedActionOrNull(action.actionType);
    const auto row = std::ranges::find(listed, action.actionType, &AgvAction::actionType);
    const bool bListed = row != listed.end();
    // A vehicle that lists nothing takes all actions of an order, each where the standard has it.
    const bool bPossible = bListed
        ? IsInScope(*row, scope)
        : listed.empty() && scope != EActionScope::Instant && (predefined == nullptr || IsInScope(*predefined, scope));
    if (!bPossible)
    {
        return ActionFault{"the vehicle cannot perform " + action.actionType + " here", "actionType"};
    }
    if (!bListed)
    {
        return std::nullopt;
    }
    if (!IsBlockingTypeKnown(*row, action, scope))
    {
        return ActionFault{
            "the vehicle does not perform " + action.actionType + " with this blocking type",
            "blockingType"};
    }
    const AgvAction& rules = GetParameterRules(*row);
    const bool bClosed =
        check == EParameterCheck::Strict || (check == EParameterCheck::Tolerant && !row->actionParameters.empty());
    return FindParameterFaultOrNull(action, rules, bClosed, check);
}

std::optional<ActionFault> FindSessionActionFaultOrNull(
    const FactsheetMessage& factsheet,
    const Action& action,
    EParameterCheck check)
{
    const std::vector<AgvAction>& listed = factsheet.protocolFeatures.agvActions;
    const auto row = std::ranges::find(listed, action.actionType, &AgvAction::actionType);
    for (const ActionParameter& given : action.actionParameters)
    {
        const bool bListed = (row != listed.end() && IsListed(*row, given.key)) || IsOfSession(action, given.key);
        if (check == EParameterCheck::Strict && !bListed)
        {
            return MakeUnknownParameter(action, given.key);
        }
    }
    return std::nullopt;
}

void ConvertTexts(const FactsheetMessage& factsheet, Action& action)
{
    const std::vector<AgvAction>& listed = factsheet.protocolFeatures.agvActions;
    const auto row = std::ranges::find(listed, action.actionType, &AgvAction::actionType);
    if (row == listed.end())
    {
        return;
    }
    for (ActionParameter& given : action.actionParameters)
    {
        const auto known = std::ranges::find(row->actionParameters, given.key, &AgvActionParameter::key);
        const std::optional<std::string> text = given.value.GetStringOrNull();
        if (known == row->actionParameters.end() || !text.has_value())
        {
            continue;
        }
        if (std::optional<Core::JsonText> value = ParseValueOrNull(*text, known->valueDataType); value.has_value())
        {
            given.value = std::move(*value);
        }
    }
}

std::vector<std::string> FindUnlistedParameters(const FactsheetMessage& factsheet, const Action& action)
{
    const std::vector<AgvAction>& listed = factsheet.protocolFeatures.agvActions;
    const auto row = std::ranges::find(listed, action.actionType, &AgvAction::actionType);
    std::vector<std::string> keys;
    for (const ActionParameter& given : action.actionParameters)
    {
        if (row != listed.end() && !IsListed(GetParameterRules(*row), given.key) && !IsOfSession(action, given.key))
        {
            keys.push_back(given.key);
        }
    }
    return keys;
}

std::optional<std::string> GetTextParameterOrNull(const Action& action, std::string_view key)
{
    const ActionParameter* parameter = FindParameterOrNull(action, key);
    return parameter == nullptr ? std::nullopt : parameter->value.GetStringOrNull();
}

std::optional<double> GetNumberParameterOrNull(const Action& action, std::string_view key)
{
    const ActionParameter* parameter = FindParameterOrNull(action, key);
    return parameter == nullptr ? std::nullopt : ReadNumberOrNull(parameter->value);
}

} // namespace ACS::VDA5050

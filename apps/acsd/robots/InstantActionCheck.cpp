#include "robots/InstantActionCheck.hpp"

#include <acs/core/Result.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

namespace ActionTypes = VDA5050::ActionTypes;

struct ManagedAction
{
    std::string_view actionType;
    std::string_view sentence;
};

/// The engine commands these, and would not know of others.
constexpr std::array<ManagedAction, 5> MANAGED{{
    {ActionTypes::CANCEL_ORDER,
     "acsd cancels the orders of its robots itself. Use /v1/plans/ID/abort (acsctl abort PLAN) instead of cancelOrder."},
    {ActionTypes::START_PAUSE,
     "acsd pauses its robots itself. Use /v1/plans/ID/pause (acsctl pause PLAN) or /v1/tsc/pause (acsctl tsc pause) instead of "
     "startPause."},
    {ActionTypes::STOP_PAUSE,
     "acsd resumes its robots itself. Use /v1/plans/ID/resume (acsctl resume PLAN) or /v1/tsc/resume (acsctl tsc resume) instead of "
     "stopPause."},
    {ActionTypes::START_CHARGING,
     "acsd charges its robots itself, by robots.NAME.charge and robot.battery_floor of the configuration. It does not send startCharging "
     "on request."},
    {ActionTypes::STOP_CHARGING,
     "acsd charges its robots itself, and ends the charging before each drive. It does not send stopCharging on request."},
}};

/// Of two parameters of a key the first one is in effect.
void KeepFirstOfEachKey(std::vector<VDA5050::AgvActionParameter>& parameters)
{
    std::set<std::string> keys;
    std::erase_if(parameters, [&keys](const VDA5050::AgvActionParameter& parameter) {
        return !keys.insert(parameter.key).second;
    });
}

std::string_view GetTypeText(VDA5050::EValueDataType type)
{
    switch (type)
    {
        case VDA5050::EValueDataType::Bool:
            return "BOOL";
        case VDA5050::EValueDataType::Number:
            return "NUMBER";
        case VDA5050::EValueDataType::Integer:
            return "INTEGER";
        case VDA5050::EValueDataType::Float:
            return "FLOAT";
        case VDA5050::EValueDataType::Object:
            return "OBJECT";
        case VDA5050::EValueDataType::Array:
            return "ARRAY";
        case VDA5050::EValueDataType::String:
        default:
            return "STRING";
    }
}

bool HasType(const Core::JsonText& value, VDA5050::EValueDataType type)
{
    const char first = value.GetText().empty() ? '\0' : value.GetText().front();
    const std::optional<double> number = value.GetNumberOrNull();
    switch (type)
    {
        case VDA5050::EValueDataType::Bool:
            return value.GetBooleanOrNull().has_value();
        case VDA5050::EValueDataType::Number:
        case VDA5050::EValueDataType::Float:
            return number.has_value();
        case VDA5050::EValueDataType::Integer:
            return number.has_value() && std::trunc(*number) == *number;
        case VDA5050::EValueDataType::Object:
            return first == '{';
        case VDA5050::EValueDataType::Array:
            return first == '[';
        case VDA5050::EValueDataType::String:
        default:
            return first == '"';
    }
}

bool IsRequired(const VDA5050::AgvActionParameter& parameter)
{
    return !parameter.bOptional.value_or(false);
}

/// "Its parameters: x (NUMBER), mapHash (STRING, optional)."
std::string DescribeParameters(const VDA5050::AgvAction& action)
{
    if (action.actionParameters.empty())
    {
        return "It has no parameters.";
    }
    std::vector<std::string> texts;
    for (const VDA5050::AgvActionParameter& parameter : action.actionParameters)
    {
        texts.push_back(fmt::format(
            "{} ({}{})",
            parameter.key,
            GetTypeText(parameter.valueDataType),
            IsRequired(parameter) ? "" : ", optional"));
    }
    return fmt::format("Its parameters: {}.", fmt::join(texts, ", "));
}

/// An entry of the standard's actions without parameters stands for those of the standard.
VDA5050::AgvAction Complete(VDA5050::AgvAction action)
{
    const VDA5050::AgvAction* const predefinedOrNull = VDA5050::FindPredefinedActionOrNull(action.actionType);
    if (action.actionParameters.empty() && predefinedOrNull != nullptr)
    {
        action.actionParameters = predefinedOrNull->actionParameters;
    }
    return action;
}

bool IsInstantAction(const VDA5050::AgvAction& action)
{
    return std::ranges::find(action.actionScopes, VDA5050::EActionScope::Instant) != action.actionScopes.end();
}

/// Of 2.1 and later.
bool IsOfMaps(std::string_view actionType)
{
    return actionType == ActionTypes::ENABLE_MAP || actionType == ActionTypes::DOWNLOAD_MAP
        || actionType == ActionTypes::DELETE_MAP;
}

std::optional<std::string> FindParameterErrorOrNull(const RobotActionRequest& request, const VDA5050::AgvAction& action)
{
    for (const VDA5050::AgvActionParameter& known : action.actionParameters)
    {
        const auto given = std::ranges::find(request.parameters, known.key, &RobotActionParameter::key);
        if (given == request.parameters.end() && IsRequired(known))
        {
            return fmt::format(
                "The parameter {} of {} is missing. {}",
                known.key,
                action.actionType,
                DescribeParameters(action));
        }
        if (given != request.parameters.end() && !HasType(given->value, known.valueDataType))
        {
            return fmt::format(
                "The parameter {} of {} has the type {}, found {}.",
                known.key,
                action.actionType,
                GetTypeText(known.valueDataType),
                Core::ShortenText(given->value.GetText()));
        }
    }
    for (const RobotActionParameter& given : request.parameters)
    {
        const auto known = std::ranges::find(action.actionParameters, given.key, &VDA5050::AgvActionParameter::key);
        if (known == action.actionParameters.end())
        {
            return fmt::format(
                "{} has no parameter {}. {}",
                action.actionType,
                Core::QuoteForError(given.key),
                DescribeParameters(action));
        }
    }
    return std::nullopt;
}

} // namespace

InstantActionCheck::InstantActionCheck(const JobMethods& methods, VDA5050::EVda5050Version version)
    : _version(version)
{
    for (const JobMethod* const method : methods.ListMethods())
    {
        if (!method->vehicleAction.empty())
        {
            _jobActions.insert(method->vehicleAction);
        }
    }
}

std::vector<RobotActionOffer> InstantActionCheck::ListOffers(const VDA5050::FactsheetMessage* factsheetOrNull) const
{
    std::vector<RobotActionOffer> offers;
    for (const VDA5050::AgvAction& action : ListActions(factsheetOrNull))
    {
        RobotActionOffer& offer = offers.emplace_back();
        offer.actionType = action.actionType;
        offer.description = action.actionDescription;
        for (const VDA5050::AgvActionParameter& parameter : action.actionParameters)
        {
            offer.parameters.push_back(
                {parameter.key, std::string(GetTypeText(parameter.valueDataType)), IsRequired(parameter)});
        }
    }
    return offers;
}

std::optional<std::string> InstantActionCheck::FindErrorOrNull(
    const RobotActionRequest& request,
    const VDA5050::FactsheetMessage* factsheetOrNull) const
{
    if (std::string replacement = FindReplacement(request.actionType); !replacement.empty())
    {
        return replacement;
    }
    const std::vector<VDA5050::AgvAction> actions = ListActions(factsheetOrNull);
    const auto action = std::ranges::find(actions, request.actionType, &VDA5050::AgvAction::actionType);
    if (action != actions.end())
    {
        return FindParameterErrorOrNull(request, *action);
    }
    std::vector<std::string_view> names;
    names.reserve(actions.size());
    for (const VDA5050::AgvAction& known : actions)
    {
        names.emplace_back(known.actionType);
    }
    return fmt::format(
        "The robot has no instant action {}. It has: {}.",
        Core::QuoteForError(request.actionType),
        fmt::join(names, ", "));
}

std::string InstantActionCheck::FindReplacement(std::string_view actionType) const
{
    const auto* const managed = std::ranges::find(MANAGED, actionType, &ManagedAction::actionType);
    if (managed != MANAGED.end())
    {
        return std::string(managed->sentence);
    }
    return _jobActions.contains(actionType)
        ? fmt::format("The robot does jobs by {}. Use a plan of the MCS instead.", actionType)
        : std::string();
}

std::vector<VDA5050::AgvAction> InstantActionCheck::ListActions(const VDA5050::FactsheetMessage* factsheetOrNull) const
{
    const bool bListed = factsheetOrNull != nullptr && !factsheetOrNull->protocolFeatures.agvActions.empty();
    std::vector<VDA5050::AgvAction> actions =
        bListed ? factsheetOrNull->protocolFeatures.agvActions : VDA5050::GetPredefinedActions();
    const auto isNotOffered = [this, bListed](const VDA5050::AgvAction& action) {
        const bool bOfVersion =
            bListed || _version != VDA5050::EVda5050Version::Version200 || !IsOfMaps(action.actionType);
        return !IsInstantAction(action) || !bOfVersion || !FindReplacement(action.actionType).empty();
    };
    std::erase_if(actions, isNotOffered);
    for (const std::string_view always : {ActionTypes::STATE_REQUEST, ActionTypes::FACTSHEET_REQUEST})
    {
        if (std::ranges::find(actions, always, &VDA5050::AgvAction::actionType) == actions.end())
        {
            actions.push_back(*VDA5050::FindPredefinedActionOrNull(always));
        }
    }
    std::ranges::transform(actions, actions.begin(), [](const VDA5050::AgvAction& action) { return Complete(action); });
    // Of two entries of a type the first one is in effect.
    std::ranges::stable_sort(actions, {}, &VDA5050::AgvAction::actionType);
    const auto end = std::unique(actions.begin(), actions.end(), [](const auto& left, const auto& right) {
        return left.actionType == right.actionType;
    });
    actions.erase(end, actions.end());
    for (VDA5050::AgvAction& action : actions)
    {
        KeepFirstOfEachKey(action.actionParameters);
    }
    return actions;
}

} // namespace ACS::Acsd

#include "robots/VehicleParameters.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using VDA5050::AgvAction;
using VDA5050::AgvActionParameter;

/// The factsheet's description of the action; null if it has none.
const AgvAction* FindListedOrNull(const VDA5050::FactsheetMessage* factsheetOrNull, const std::string& actionType)
{
    if (factsheetOrNull == nullptr)
    {
        return nullptr;
    }
    const std::vector<AgvAction>& listed = factsheetOrNull->protocolFeatures.agvActions;
    const auto row = std::ranges::find(listed, actionType, &AgvAction::actionType);
    return row == listed.end() ? nullptr : &*row;
}

const AgvActionParameter* FindParameterOrNull(const AgvAction* actionOrNull, const std::string& key)
{
    if (actionOrNull == nullptr)
    {
        return nullptr;
    }
    const auto row = std::ranges::find(actionOrNull->actionParameters, key, &AgvActionParameter::key);
    return row == actionOrNull->actionParameters.end() ? nullptr : &*row;
}

bool IsMandatory(const AgvActionParameter* parameterOrNull)
{
    return parameterOrNull != nullptr && !parameterOrNull->bOptional.value_or(false);
}

/// A mandatory parameter of the factsheet that has no template.
const AgvActionParameter* FindUnnamedOrNull(const AgvAction& listed, const JobMethod& method)
{
    const auto unnamed = std::ranges::find_if(listed.actionParameters, [&method](const AgvActionParameter& rule) {
        return IsMandatory(&rule) && std::ranges::count(method.parameters, rule.key, &VehicleParameter::key) == 0;
    });
    return unnamed == listed.actionParameters.end() ? nullptr : &*unnamed;
}

/// Most parameters of an action; nullopt: no limit.
std::optional<std::size_t> GetMostParametersOrNull(const VDA5050::FactsheetMessage* factsheetOrNull)
{
    const std::uint32_t most =
        factsheetOrNull == nullptr ? 0 : factsheetOrNull->protocolLimits.maxArrayLengths.actionParameters.value_or(0);
    return most == 0 ? std::nullopt : std::optional<std::size_t>(most);
}

std::string DescribeTooMany(const std::string& actionType, std::size_t count, std::size_t most)
{
    return fmt::format(
        "{} has {} parameters, and the factsheet allows {} (maxArrayLens.actions.actionsParameters)",
        actionType,
        count,
        most);
}

/// Where the factsheet lists no parameters, those of the standard's action are in force.
const AgvAction* GetRulesOrNull(const AgvAction* listedOrNull, const std::string& actionType)
{
    return listedOrNull == nullptr || listedOrNull->actionParameters.empty()
        ? VDA5050::FindPredefinedActionOrNull(actionType)
        : listedOrNull;
}

} // namespace

std::optional<std::string> FindMethodFaultOrNull(const JobMethod& method, const VDA5050::FactsheetMessage& factsheet)
{
    const std::string& actionType = method.vehicleAction;
    const AgvAction* const listedOrNull = FindListedOrNull(&factsheet, actionType);
    const AgvAction* const rulesOrNull = GetRulesOrNull(listedOrNull, actionType);
    const auto mandatory = static_cast<std::size_t>(
        std::ranges::count_if(method.parameters, [rulesOrNull](const VehicleParameter& parameter) {
            return IsMandatory(FindParameterOrNull(rulesOrNull, parameter.key));
        }));
    const std::size_t most = GetMostParametersOrNull(&factsheet).value_or(mandatory);
    if (mandatory > most)
    {
        return DescribeTooMany(actionType, mandatory, most);
    }
    if (listedOrNull == nullptr)
    {
        return factsheet.protocolFeatures.agvActions.empty()
            ? std::nullopt
            : std::optional(fmt::format("the vehicle's factsheet does not list {}", actionType));
    }
    if (!VDA5050::CanPerform(factsheet, actionType, VDA5050::EActionScope::Node))
    {
        return fmt::format("the vehicle's factsheet does not list {} with the scope NODE", actionType);
    }
    const std::vector<VDA5050::EBlockingType>& blockingTypes = listedOrNull->blockingTypes;
    if (!blockingTypes.empty() && std::ranges::find(blockingTypes, JOB_BLOCKING) == blockingTypes.end())
    {
        return fmt::format("the vehicle's factsheet does not list {} with the blocking type HARD", actionType);
    }
    if (listedOrNull->actionParameters.empty())
    {
        return std::nullopt; // the factsheet lists no parameters
    }
    for (const VehicleParameter& parameter : method.parameters)
    {
        if (!parameter.bDefault && FindParameterOrNull(listedOrNull, parameter.key) == nullptr)
        {
            return fmt::format(
                "the vehicle's factsheet does not list the parameter {} of {}",
                parameter.key,
                actionType);
        }
    }
    const AgvActionParameter* const unnamedOrNull = FindUnnamedOrNull(*listedOrNull, method);
    return unnamedOrNull == nullptr
        ? std::nullopt
        : std::optional(
            fmt::format("the parameter {} of {} is mandatory and not configured", unnamedOrNull->key, actionType));
}

tl::expected<std::vector<VDA5050::ActionParameter>, std::string> MakeActionParameters(
    const JobMethod& method,
    const JobData& data,
    const VDA5050::FactsheetMessage* factsheetOrNull)
{
    const std::string& actionType = method.vehicleAction;
    std::optional<std::string> fault =
        factsheetOrNull == nullptr ? std::nullopt : FindMethodFaultOrNull(method, *factsheetOrNull);
    const AgvAction* listedOrNull = FindListedOrNull(factsheetOrNull, actionType);
    if (fault.has_value() && listedOrNull == nullptr)
    {
        return tl::unexpected(std::move(*fault));
    }
    if (listedOrNull != nullptr && listedOrNull->actionParameters.empty())
    {
        listedOrNull = nullptr; // the factsheet lists no parameters
    }
    const AgvAction* const rulesOrNull = GetRulesOrNull(listedOrNull, actionType);
    std::vector<VDA5050::ActionParameter> parameters;
    std::vector<std::string> omittable; // defaults that are not mandatory, in the order of the parameters
    for (const VehicleParameter& parameter : method.parameters)
    {
        const AgvActionParameter* const knownOrNull = FindParameterOrNull(listedOrNull, parameter.key);
        if (listedOrNull != nullptr && knownOrNull == nullptr)
        {
            continue; // one of the defaults, or a fault
        }
        const bool bMandatory = IsMandatory(FindParameterOrNull(rulesOrNull, parameter.key));
        tl::expected<Core::JsonText, std::string> value = parameter.value.Resolve(
            data,
            knownOrNull == nullptr ? std::nullopt : std::optional(knownOrNull->valueDataType));
        if (value.has_value())
        {
            parameters.push_back({parameter.key, std::move(*value)});
            if (parameter.bDefault && !bMandatory)
            {
                omittable.push_back(parameter.key);
            }
        }
        else if (bMandatory)
        {
            return tl::unexpected(
                fmt::format("the parameter {} of {} cannot be given: {}", parameter.key, actionType, value.error()));
        }
    }
    if (fault.has_value())
    {
        return tl::unexpected(std::move(*fault));
    }
    const std::size_t most = GetMostParametersOrNull(factsheetOrNull).value_or(parameters.size());
    for (; parameters.size() > most && !omittable.empty(); omittable.pop_back())
    {
        std::erase_if(parameters, [&omittable](const VDA5050::ActionParameter& parameter) {
            return parameter.key == omittable.back();
        });
    }
    if (parameters.size() > most)
    {
        return tl::unexpected(DescribeTooMany(actionType, parameters.size(), most));
    }
    return parameters;
}

} // namespace ACS::Acsd

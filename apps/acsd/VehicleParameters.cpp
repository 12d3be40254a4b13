#include "VehicleParameters.hpp"

#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using VDA5050::AgvAction;
using VDA5050::AgvActionParameter;

/// The vehicle's own description of the action; null where it gives none, or none of its parameters.
const AgvAction* FindListedOrNull(const VDA5050::FactsheetMessage* factsheetOrNull, const std::string& actionType)
{
    if (factsheetOrNull == nullptr)
    {
        return nullptr;
    }
    const std::vector<AgvAction>& listed = factsheetOrNull->protocolFeatures.agvActions;
    const auto row = std::ranges::find(listed, actionType, &AgvAction::actionType);
    return row == listed.end() || row->actionParameters.empty() ? nullptr : &*row;
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

bool HasKey(const StationTable& stations, const std::string& key)
{
    return std::ranges::any_of(stations, [&key](const auto& station) { return station.second.contains(key); });
}

} // namespace

tl::expected<std::vector<VDA5050::ActionParameter>, std::string> MakeActionParameters(
    const JobMethod& method,
    const JobData& data,
    const VDA5050::FactsheetMessage* factsheetOrNull)
{
    const AgvAction* const listedOrNull = FindListedOrNull(factsheetOrNull, method.vehicleAction);
    const AgvAction* const rulesOrNull =
        listedOrNull == nullptr ? VDA5050::FindPredefinedActionOrNull(method.vehicleAction) : listedOrNull;
    std::vector<VDA5050::ActionParameter> parameters;
    for (const VehicleParameter& parameter : method.parameters)
    {
        const AgvActionParameter* const knownOrNull = FindParameterOrNull(listedOrNull, parameter.key);
        if (parameter.bDefault && listedOrNull != nullptr && knownOrNull == nullptr)
        {
            continue;
        }
        tl::expected<Core::JsonText, ParameterFault> value = parameter.value.Resolve(
            data,
            knownOrNull == nullptr ? std::nullopt : std::optional(knownOrNull->valueDataType));
        if (value.has_value())
        {
            parameters.push_back({parameter.key, std::move(*value)});
        }
        else if (!value.error().missing.has_value() || IsMandatory(FindParameterOrNull(rulesOrNull, parameter.key)))
        {
            return tl::unexpected(fmt::format(
                "the parameter {} of {} cannot be given: {}",
                parameter.key,
                method.vehicleAction,
                value.error().reason));
        }
    }
    if (listedOrNull != nullptr)
    {
        for (const AgvActionParameter& rule : listedOrNull->actionParameters)
        {
            if (IsMandatory(&rule) && std::ranges::count(method.parameters, rule.key, &VehicleParameter::key) == 0)
            {
                return tl::unexpected(fmt::format(
                    "the parameter {} of {} is mandatory and not configured",
                    rule.key,
                    method.vehicleAction));
            }
        }
    }
    return parameters;
}

std::optional<std::string> FindParameterFaultOrNull(const JobMethod& method, const StationTable& stations)
{
    const AgvAction* const rulesOrNull = VDA5050::FindPredefinedActionOrNull(method.vehicleAction);
    for (const VehicleParameter& parameter : method.parameters)
    {
        if (!IsMandatory(FindParameterOrNull(rulesOrNull, parameter.key)))
        {
            continue;
        }
        for (const JobName& name : parameter.value.GetNames())
        {
            if (name.subject == JobName::ESubject::Station && !HasKey(stations, name.key))
            {
                return fmt::format(
                    "the parameter {} of {} cannot be given: no station has a {}",
                    parameter.key,
                    method.vehicleAction,
                    name.key);
            }
        }
    }
    return std::nullopt;
}

} // namespace ACS::Acsd

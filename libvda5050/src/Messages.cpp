#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <algorithm>

namespace ACS::VDA5050
{

const ActionParameter* FindParameterOrNull(const Action& action, std::string_view key)
{
    const auto found = std::ranges::find(action.actionParameters, key, &ActionParameter::key);
    return found == action.actionParameters.end() ? nullptr : &*found;
}

bool IsLedByMaster(EOperatingMode mode)
{
    return mode == EOperatingMode::Automatic || mode == EOperatingMode::SemiAutomatic;
}

const std::string* FindReferenceOrNull(const VehicleError& error, std::string_view key)
{
    const auto found = std::ranges::find(error.errorReferences, key, &ErrorReference::referenceKey);
    return found == error.errorReferences.end() ? nullptr : &found->referenceValue;
}

bool CanPerform(const FactsheetMessage& factsheet, std::string_view actionType, EActionScope scope)
{
    const auto isMatch = [actionType, scope](const AgvAction& action) {
        return action.actionType == actionType
            && std::ranges::find(action.actionScopes, scope) != action.actionScopes.end();
    };
    return std::ranges::any_of(factsheet.protocolFeatures.agvActions, isMatch);
}

bool IsSupported(const FactsheetMessage& factsheet, std::string_view parameter)
{
    const std::optional<std::vector<OptionalParameter>>& list = factsheet.protocolFeatures.optionalParameters;
    return !list.has_value() || std::ranges::any_of(*list, [parameter](const OptionalParameter& listed) {
        const std::string_view path = listed.parameter;
        return path.starts_with(parameter) && (path.size() == parameter.size() || path[parameter.size()] == '.');
    });
}

} // namespace ACS::VDA5050

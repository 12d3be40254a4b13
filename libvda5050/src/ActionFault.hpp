#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/EParameterCheck.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Why a vehicle cannot perform an action, and the field that is to blame.
struct ActionFault
{
    std::string rule;
    std::string field; ///< "actionType", "blockingType", or the key of a parameter.
};

/// Holds an action against the factsheet's row for it, and where the row has no parameters against the standard's.
/// Without any agvActions only the scope of predefined actions is checked.
[[nodiscard]] std::optional<ActionFault> FindActionFaultOrNull(
    const FactsheetMessage& factsheet,
    const Action& action,
    EActionScope scope,
    EParameterCheck check);

/// Of an action that the session performs itself, also if the factsheet does not list it: only Strict refuses parameters.
[[nodiscard]] std::optional<ActionFault> FindSessionActionFaultOrNull(
    const FactsheetMessage& factsheet,
    const Action& action,
    EParameterCheck check);

/// Replaces texts by the number or boolean that they state where the factsheet lists the parameter as NUMBER, FLOAT, INTEGER
/// or BOOL. Other texts stay: FindActionFaultOrNull finds them.
void ConvertTexts(const FactsheetMessage& factsheet, Action& action);

/// The keys of the action's parameters that the factsheet does not list, or the standard if the factsheet lists none of
/// the action; none where it does not list the action.
[[nodiscard]] std::vector<std::string> FindUnlistedParameters(const FactsheetMessage& factsheet, const Action& action);

/// The parameter as text or as a number, which may be written as text too; nullopt where it is absent or something else.
[[nodiscard]] std::optional<std::string> GetTextParameterOrNull(const Action& action, std::string_view key);
[[nodiscard]] std::optional<double> GetNumberParameterOrNull(const Action& action, std::string_view key);

} // namespace ACS::VDA5050

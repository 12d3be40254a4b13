#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The predefined actions of 2.0 and 2.1 (section 6.8.1) with their scopes and parameters, in the form of a factsheet. A
/// vehicle copies the entries that it supports.
[[nodiscard]] ACS_API const std::vector<AgvAction>& GetPredefinedActions();

/// Null for a vendor-specific action.
[[nodiscard]] ACS_API const AgvAction* FindPredefinedActionOrNull(std::string_view actionType);

} // namespace ACS::VDA5050

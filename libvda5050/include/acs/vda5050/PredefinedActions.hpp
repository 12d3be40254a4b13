#pragma once

#include <acs/vda5050/FactsheetMessage.hpp>

#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The actions that 2.0 and 2.1 name (section 6.8.2): where each may stand and its parameters, as a factsheet lists
/// them. A vehicle that can do one copies its row.
[[nodiscard]] const std::vector<AgvAction>& GetPredefinedActions();

/// Null for an action of a vendor's own.
[[nodiscard]] const AgvAction* FindPredefinedActionOrNull(std::string_view actionType);

} // namespace ACS::VDA5050

#pragma once

#include <acs/vda5050/FactsheetMessage.hpp>

#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// What a factsheet contradicts itself in, or demands of orders that no order has; a phrase each. Such a factsheet is obeyed as far
/// as possible: the first of two equal entries is in effect, and an unknown member is not sent.
[[nodiscard]] std::vector<std::string> FindContradictions(const FactsheetMessage& factsheet);

} // namespace ACS::VDA5050

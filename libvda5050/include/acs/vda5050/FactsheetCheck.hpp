#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// Seconds: ten times the interval of states in VDA5050. A vehicle whose factsheet states a longer interval of orders or states can
/// hardly be used; probably the value is in milliseconds.
inline constexpr double LONGEST_PLAUSIBLE_INTERVAL = 300.0;

/// What a factsheet contradicts itself in, demands of orders that no order has, or states beyond reason; a phrase each, with the
/// names of the factsheet in full. Such a factsheet is obeyed as far as possible: the first of two equal entries is in effect, an
/// unknown member is not sent, and intervals are kept. The time is linear in the length of the factsheet.
[[nodiscard]] ACS_API std::vector<std::string> FindContradictions(const FactsheetMessage& factsheet);

} // namespace ACS::VDA5050

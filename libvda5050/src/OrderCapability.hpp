#pragma once

#include <acs/vda5050/OrderValidator.hpp>

#include <vector>

namespace ACS::VDA5050
{

/// What of an order the vehicle cannot do: actions, optional members, sizes, maps, zone sets. Each an orderError that refers
/// to the field.
[[nodiscard]] std::vector<OrderViolation> FindUnusable(const OrderMessage& order, const OrderContext& context);

/// Leaves out optional members that the vehicle does not support and can do without, and fills in those that it requires where a
/// value restricts nothing. Gives texts of action parameters the listed type (ConvertTexts). FindUnusable finds the others.
void AdaptToFactsheet(OrderMessage& order, const FactsheetMessage& factsheet);

/// The optional members that FindUnusable checks, as supported ones.
[[nodiscard]] std::vector<OptionalParameter> ListOptionalParameters();

} // namespace ACS::VDA5050

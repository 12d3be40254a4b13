#pragma once

#include "ActionFault.hpp"
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The sizes that a factsheet can limit, of one message and of the state that would follow it. The ids belong to what
/// was measured.
struct MessageSizes
{
    std::size_t payload = 0;
    std::size_t nodes = 0;
    std::size_t edges = 0;
    std::size_t nodeActions = 0;
    std::size_t edgeActions = 0;
    std::size_t parameters = 0;
    std::size_t knots = 0;
    std::size_t controlPoints = 0;
    std::size_t nodeStates = 0;
    std::size_t edgeStates = 0;
    std::size_t actionStates = 0;
    std::size_t stateBytes = 0; ///< Of what follows from orders.
    std::vector<std::string_view> ids;
};

[[nodiscard]] MessageSizes Measure(const OrderMessage& order);
[[nodiscard]] MessageSizes Measure(const Action& action);

/// What is larger than the vehicle allows, or than a state has room for; the field is the name of the limit
/// and begins with "max": master control then sends a shorter horizon or base.
[[nodiscard]] std::vector<ActionFault> FindSizeFaults(const MessageSizes& sizes, const ProtocolLimits& limits);

} // namespace ACS::VDA5050

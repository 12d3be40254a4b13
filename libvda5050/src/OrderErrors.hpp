#pragma once

#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// Why an order is refused outside of the automatic modes; the report ends with the mode.
inline constexpr std::string_view MODE_TAKES_NO_ORDERS = "the operating mode takes no orders";

/// The keys of references (best practice of section 7.1). topic is always sent: some masters know a rejection by it.
namespace ReferenceKeys
{
inline constexpr std::string_view TOPIC = "topic";
inline constexpr std::string_view HEADER_ID = "headerId";
inline constexpr std::string_view ORDER_ID = "orderId";
inline constexpr std::string_view ORDER_UPDATE_ID = "orderUpdateId";
inline constexpr std::string_view ACTION_ID = "actionId";
inline constexpr std::string_view NODE_ID = "nodeId";
inline constexpr std::string_view EDGE_ID = "edgeId";
inline constexpr std::string_view MAP_ID = "mapId";
inline constexpr std::string_view PARAMETER = "parameter"; ///< The name of the wrong field.
} // namespace ReferenceKeys

inline void AddReference(VehicleError& error, std::string_view key, std::string_view value)
{
    error.errorReferences.push_back(ErrorReference{std::string(key), std::string(value)});
}

} // namespace ACS::VDA5050

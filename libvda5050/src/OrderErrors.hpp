#pragma once

#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace ACS::VDA5050
{

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
} // namespace ReferenceKeys

inline void AddReference(VehicleError& error, std::string_view key, std::string value)
{
    error.errorReferences.push_back(ErrorReference{std::string(key), std::move(value)});
}

/// A warning about an order message, with the references that every such error has.
[[nodiscard]] inline VehicleError MakeOrderError(
    const OrderMessage& order,
    std::string_view errorType,
    std::string description)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorDescription = std::move(description);
    AddReference(error, ReferenceKeys::TOPIC, "order");
    AddReference(error, ReferenceKeys::HEADER_ID, std::to_string(order.header.headerID));
    AddReference(error, ReferenceKeys::ORDER_ID, order.orderID);
    AddReference(error, ReferenceKeys::ORDER_UPDATE_ID, std::to_string(order.orderUpdateID));
    return error;
}

} // namespace ACS::VDA5050

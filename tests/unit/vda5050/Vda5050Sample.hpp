#pragma once

#include "ManualClock.hpp"
#include "SchemaCheck.hpp"
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Topic.hpp>
#include <acs/vda5050/VehicleAction.hpp>

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace ACS::VDA5050::Test
{

[[nodiscard]] VehicleAddress MakeAddress();
[[nodiscard]] Action MakeAction(std::string actionID, EBlockingType blockingType, std::string actionType = "pick");

/// N0 at the origin, N1 at x = 10, N2 at x = 20, …; edges E0, E1, …
[[nodiscard]] std::vector<OrderNode> MakeNodes(std::size_t count);
[[nodiscard]] std::vector<OrderEdge> MakeEdges(std::size_t count);
[[nodiscard]] OrderBuilder MakeBuilder(std::size_t nodeCount, std::string orderID = "order-1");
/// All nodes, the first releasedNodes of them as base.
[[nodiscard]] OrderMessage MakeOrder(std::size_t nodeCount, std::size_t releasedNodes, std::string orderID = "order-1");
/// The order whose base grows from releasedBefore to releasedNow.
[[nodiscard]] OrderMessage MakeUpdate(std::size_t nodeCount, std::size_t releasedBefore, std::size_t releasedNow);

/// The actions of one kind, in order.
template <typename TWanted, typename TAction>
[[nodiscard]] std::vector<TWanted> Pick(const std::vector<TAction>& actions)
{
    std::vector<TWanted> picked;
    for (const TAction& action : actions)
    {
        if (const auto* wanted = std::get_if<TWanted>(&action))
        {
            picked.push_back(*wanted);
        }
    }
    return picked;
}

/// Every message that a session published among these is valid for the official schema of its version.
template <typename TAction>
void CheckPublished(const std::vector<TAction>& actions)
{
    for (const PublishMessage& publish : Pick<PublishMessage>(actions))
    {
        Testing::CheckValid(publish.message.topic, publish.message.payload);
    }
}

[[nodiscard]] std::vector<std::string> ListNodes(const StateMessage& state);

} // namespace ACS::VDA5050::Test

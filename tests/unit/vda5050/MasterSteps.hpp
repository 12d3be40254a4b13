#pragma once

#include "MasterSessionFixture.hpp"

#include <cstddef>
#include <string>

namespace ACS::VDA5050::Test
{

/// An accepted order over this number of nodes with an action on the last, which the vehicle shows with this status.
inline OrderMessage SendOrderWithAction(MasterSessionFixture& bench, std::size_t nodeCount, EActionStatus status)
{
    bench.BeReady();
    OrderMessage order = MakeOrder(nodeCount, nodeCount);
    order.nodes.back().actions.push_back(MakeAction("a1", EBlockingType::Hard));
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, nodeCount - 1);
    bench.state.actionStates = {ActionState{"a1", "pick", {}, status, {}}};
    bench.SendState();
    REQUIRE(bench.session.GetOrderPhase() == EOrderPhase::Active);
    bench.Clear();
    return order;
}

/// An accepted order over three nodes with an action on the last.
inline OrderMessage SendFirstOrder(MasterSessionFixture& bench)
{
    return SendOrderWithAction(bench, 3, EActionStatus::Waiting);
}

inline std::string CancelOrder(MasterSessionFixture& bench)
{
    REQUIRE(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value());
    const auto message =
        Vda5050Codec().Decode<InstantActionsMessage>(bench.GetSent(ETopic::InstantActions).back().payload);
    return message->actions.front().actionID;
}

/// The vehicle drives an order of another master, with two nodes left.
inline OrderMessage BeginForeignOrder(MasterSessionFixture& bench)
{
    OrderMessage foreign = MakeOrder(3, 3);
    foreign.orderID = "foreign";
    bench.Hold(foreign, 2);
    bench.BeReady();
    return foreign;
}

} // namespace ACS::VDA5050::Test

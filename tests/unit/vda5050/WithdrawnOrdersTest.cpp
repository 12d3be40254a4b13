#include "WithdrawnOrders.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <string>

namespace ACS::VDA5050::Test
{

namespace
{

using EReappearance = WithdrawnOrders::EReappearance;

StateMessage MakeStateOf(const std::string& orderID)
{
    StateMessage state;
    state.orderID = orderID;
    return state;
}

OrderMessage MakeMessageWithAction(const std::string& actionID)
{
    OrderMessage message;
    message.nodes.emplace_back().actions.push_back(MakeAction(actionID, EBlockingType::None));
    return message;
}

} // namespace

TEST_CASE("6.6.3 A withdrawn order that the vehicle drives is running, and reappears once")
{
    WithdrawnOrders orders;
    orders.Add("O1", nullptr, false);
    StateMessage state = MakeStateOf("O1");
    state.nodeStates.emplace_back();
    CHECK_FALSE(orders.TakeReappearedOrNull(MakeStateOf("O2")).has_value());
    CHECK(orders.TakeReappearedOrNull(state) == EReappearance::Running);
    CHECK_FALSE(orders.TakeReappearedOrNull(state).has_value());
}

TEST_CASE("6.6.3 A withdrawn order whose action has not ended is running")
{
    WithdrawnOrders orders;
    const OrderMessage message = MakeMessageWithAction("A1");
    orders.Add("O1", &message, false);
    StateMessage state = MakeStateOf("O1");
    state.actionStates.push_back(ActionState{"other", "pick", {}, EActionStatus::Running, {}});
    CHECK_FALSE(orders.TakeReappearedOrNull(state).has_value());
    state.actionStates.push_back(ActionState{"A1", "pick", {}, EActionStatus::Running, {}});
    CHECK(orders.TakeReappearedOrNull(state) == EReappearance::Running);
}

TEST_CASE("6.6.3 Only an order that was not cancelled is reported as ended")
{
    WithdrawnOrders orders;
    orders.Add("cancelled", nullptr, false);
    orders.Add("rejected", nullptr, true);
    CHECK_FALSE(orders.TakeReappearedOrNull(MakeStateOf("cancelled")).has_value());
    CHECK(orders.TakeReappearedOrNull(MakeStateOf("rejected")) == EReappearance::Ended);
}

TEST_CASE("6.6.3 The last 16 withdrawn orders are remembered, without those that were sent again")
{
    WithdrawnOrders orders;
    for (int i = 0; i < 17; ++i)
    {
        orders.Add("O" + std::to_string(i), nullptr, true);
    }
    orders.Remove("O2");
    CHECK_FALSE(orders.TakeReappearedOrNull(MakeStateOf("O0")).has_value());
    CHECK(orders.TakeReappearedOrNull(MakeStateOf("O1")).has_value());
    CHECK_FALSE(orders.TakeReappearedOrNull(MakeStateOf("O2")).has_value());
}

} // namespace ACS::VDA5050::Test

#include "MasterSessionFixture.hpp"

#include <string>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// An accepted order over four nodes, two of them released, and its update, which is sent and not shown.
OrderMessage SendUpdate(MasterSessionFixture& bench)
{
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.SendState();
    const OrderMessage update = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.GetSentOrder().orderUpdateID == 1);
    return update;
}

} // namespace

TEST_CASE("13 After an outage an order that was not shown is resent only if the vehicle cannot have executed it")
{
    MasterSessionFixture bench;
    const std::string before = GENERATE("", "order-0");
    bench.state.orderID = before;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(3, 3), bench.GetNow(), bench.Clear()).has_value());
    bench.Connect(EConnectionState::ConnectionBroken);
    bench.Clear();
    bench.Connect(EConnectionState::Online);
    CHECK(bench.GetSent(ETopic::Order).empty()); // what it shows now decides
    SECTION("it shows the order before this one: this one did not reach it")
    {
        bench.SendState();
        const bool bKnown = !before.empty();
        CHECK(bench.GetSent(ETopic::Order).size() == (bKnown ? 1 : 0));
        CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (bKnown ? 0 : 1));
    }
    SECTION("it shows no order: it may have executed this one before it was restarted")
    {
        bench.state.orderID.clear();
        bench.SendState();
        CHECK(bench.GetSent(ETopic::Order).empty());
        CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
        CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
    }
    SECTION("it shows the order")
    {
        bench.Hold(MakeOrder(3, 3), 2);
        bench.SendState();
        CHECK(bench.GetSent(ETopic::Order).empty());
        CHECK(Pick<OrderAccepted>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("13 After an outage an update that the first state shows is not sent again")
{
    MasterSessionFixture bench;
    const OrderMessage update = SendUpdate(bench);
    if (GENERATE(true, false))
    {
        bench.Connect(EConnectionState::ConnectionBroken);
    }
    else
    {
        bench.session.OnLinkDown(bench.GetNow(), bench.Clear());
        bench.session.OnLinkUp(bench.GetNow(), bench.Clear());
    }
    bench.Clear();
    bench.Hold(update, 2);
    bench.SendState();
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 1}});
}

} // namespace ACS::VDA5050::Test

#include "MasterSessionFixture.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// An accepted order over four nodes, two of them released, and its update, which is sent and not shown.
OrderMessage SendUpdate(MasterSessionFixture& bench)
{
    if (bench.session.GetLink() != EVehicleLink::Online)
    {
        bench.Connect(EConnectionState::Online);
    }
    bench.SendState();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.SendState();
    OrderMessage update = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.GetSentOrder().orderUpdateID == 1);
    return update;
}

/// ONLINE of the vehicle, which was not reported as gone.
void Announce(MasterSessionFixture& bench, std::uint32_t headerID, Core::WallTime timestamp, bool bRetained)
{
    ConnectionMessage message;
    message.header = Header{headerID, timestamp, "2.0.0", "ACS", "LR01"};
    message.connectionState = EConnectionState::Online;
    const std::string payload = Vda5050Codec().Encode(message, EVda5050Version::Version200);
    bench.Clear();
    bench.session.OnMessage(
        MqttMessage{BuildTopic(MakeAddress(), ETopic::Connection), payload, 1, bRetained},
        bench.GetNow(),
        bench.Clear());
}

std::vector<std::string> ListSentInstantActions(const MasterSessionFixture& bench)
{
    std::vector<std::string> types;
    for (const MqttMessage& sent : bench.GetSent(ETopic::InstantActions))
    {
        const auto message = Vda5050Codec().Decode<InstantActionsMessage>(sent.payload);
        REQUIRE(message.has_value());
        std::ranges::transform(message->actions, std::back_inserter(types), &Action::actionType);
    }
    return types;
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

TEST_CASE("13 After an outage an update is sent again only if the vehicle shows that it still has the order")
{
    MasterSessionFixture bench;
    const OrderMessage update = SendUpdate(bench);
    bench.Connect(EConnectionState::ConnectionBroken);
    bench.Clear();
    bench.Connect(EConnectionState::Online);
    if (GENERATE(true, false))
    {
        bench.Wait(std::chrono::seconds(40), EMasterTimer::Silence);
    }
    CHECK(bench.GetSent(ETopic::Order).empty()); // to a vehicle that was restarted it would be a new order
    bench.Clear();
    SECTION("it has it")
    {
        bench.SendState();
        REQUIRE(bench.GetSent(ETopic::Order).size() == 1);
        CHECK(bench.GetSentOrder().orderUpdateID == 1);
    }
    SECTION("it was restarted, and the update that was sent before reaches it late")
    {
        bench.state = StateMessage();
        bench.SendState();
        CHECK(bench.GetSent(ETopic::Order).empty());
        CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
        bench.Clear();
        bench.Hold(update, 2);
        bench.SendState();
        CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
        CHECK(ListSentInstantActions(bench) == std::vector<std::string>{"cancelOrder"});
    }
}

TEST_CASE("13 An update that is given while the vehicle is away is not sent before its first state")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.SendState();
    bench.Connect(EConnectionState::ConnectionBroken);
    const bool bBeforeOnline = GENERATE(true, false);
    const OrderMessage update = *builder.MakeUpdate(3);
    if (bBeforeOnline)
    {
        REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    }
    bench.Clear();
    bench.Connect(EConnectionState::Online);
    CHECK(bench.GetSent(ETopic::Order).empty());
    if (!bBeforeOnline)
    {
        REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
        CHECK(bench.GetSent(ETopic::Order).empty());
    }
    bench.Clear();
    const bool bRestarted = GENERATE(true, false);
    bench.state = bRestarted ? StateMessage() : bench.state;
    bench.SendState();
    CHECK(bench.GetSent(ETopic::Order).size() == (bRestarted ? 0 : 1));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (bRestarted ? 1 : 0));
}

TEST_CASE("13 An ONLINE with a restarted headerId, without a will before it, is that of a vehicle that was restarted")
{
    struct Row
    {
        std::uint32_t headerID; ///< After 4.
        std::chrono::seconds age;
        bool bRetained;
        bool bRestarted;
    };
    const Row row = GENERATE(
        Row{0, std::chrono::seconds(0), false, true},
        Row{4, std::chrono::seconds(0), false, true},
        Row{4, std::chrono::seconds(5), false, false}, // a duplicate of QoS 1
        Row{5, std::chrono::seconds(0), false, false}, // sent periodically
        Row{0, std::chrono::seconds(0), true, false});
    CAPTURE(row.headerID, row.age.count(), row.bRetained);
    MasterSessionFixture bench;
    Announce(bench, 4, bench.GetNow().wall - std::chrono::seconds(5), false);
    const OrderMessage update = SendUpdate(bench);
    Announce(bench, 4, bench.GetNow().wall - std::chrono::seconds(5), false);
    CHECK(ListSentInstantActions(bench).empty());
    Announce(bench, row.headerID, bench.GetNow().wall - row.age, row.bRetained);
    CHECK(ListSentInstantActions(bench).size() == (row.bRestarted ? 2 : 0)); // the state and the factsheet
    CHECK(Pick<VehicleOnline>(bench.GetOutput()).size() == (row.bRestarted ? 1 : 0));
    CHECK(bench.session.IsReady() != row.bRestarted);
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).size() == (row.bRestarted ? 0 : 1));
    bench.Clear();
    bench.state = StateMessage();
    bench.SendState();
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 A first order is not sent again to a vehicle that reports ONLINE once more after a restart")
{
    MasterSessionFixture bench;
    Announce(bench, 4, bench.GetNow().wall, false);
    bench.SendState();
    REQUIRE(bench.session.SendOrder(MakeOrder(3, 3), bench.GetNow(), bench.Clear()).has_value());
    Announce(bench, 0, bench.GetNow().wall, false);
    bench.SendState();
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1); // it may have executed it
}

} // namespace ACS::VDA5050::Test

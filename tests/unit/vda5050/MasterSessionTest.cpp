#include "Catch.hpp"
#include "MasterSessionFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>

namespace ACS::VDA5050::Test
{

TEST_CASE("6 ONLINE requests state and factsheet; OFFLINE, the will and repeated retained messages are reported once")
{
    MasterSessionFixture bench;
    CHECK(bench.session.GetSubscriptions().size() == 4);
    bench.Connect(EConnectionState::ConnectionBroken);
    bench.Connect(EConnectionState::Online);
    bench.Connect(EConnectionState::Online);
    CHECK(Pick<VehicleBroken>(bench.GetOutput()).size() == 1);
    CHECK(Pick<VehicleOnline>(bench.GetOutput()).size() == 1);
    const auto sent = bench.GetSent(ETopic::InstantActions);
    REQUIRE(sent.size() == 2); // a vehicle of unknown limits may accept one action in a message
    CHECK(sent[0].qos == 2);
    for (const std::size_t index : {0U, 1U})
    {
        const auto request = Vda5050Codec().Decode<InstantActionsMessage>(sent[index].payload);
        REQUIRE(request.has_value());
        REQUIRE(request->actions.size() == 1);
        CHECK(request->actions[0].actionType == (index == 0 ? "stateRequest" : "factsheetRequest"));
        CHECK(request->actions[0].blockingType == EBlockingType::None);
    }
    CHECK_FALSE(bench.session.CanTakeOrder());
    bench.SendState();
    CHECK(bench.session.CanTakeOrder());
    bench.Connect(EConnectionState::Offline);
    CHECK(Pick<VehicleOffline>(bench.GetOutput()).size() == 1);
    CHECK_FALSE(bench.session.IsReady());
}

TEST_CASE("6 ONLINE requests the factsheet again, which may have changed")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.Deliver(ETopic::Factsheet, Vda5050Codec().Encode(FactsheetMessage(), EVda5050Version::Version210));
    REQUIRE(bench.session.GetFactsheetOrNull() != nullptr);
    bench.Connect(EConnectionState::Offline);
    static_cast<void>(bench.Clear());
    bench.Connect(EConnectionState::Online);
    const auto sent = bench.GetSent(ETopic::InstantActions);
    REQUIRE(sent.size() == 1);
    const auto request = Vda5050Codec().Decode<InstantActionsMessage>(sent[0].payload);
    REQUIRE(request.has_value());
    CHECK(std::ranges::count(request->actions, "factsheetRequest", &Action::actionType) == 1);
}

TEST_CASE("13 State and factsheet are requested in one message where the factsheet allows two instant actions")
{
    for (const std::uint32_t most : {0U, 1U, 2U}) // 0: no limit
    {
        MasterOptions options = MakeMasterOptions();
        options.factsheet.emplace().protocolLimits.maxArrayLengths.instantActions = most;
        MasterSessionFixture bench(options);
        bench.Connect(EConnectionState::Online);
        CHECK(bench.GetSent(ETopic::InstantActions).size() == (most == 1 ? 2 : 1));
    }
}

TEST_CASE("2 The version of the last message is recorded, also of one that is refused")
{
    MasterSessionFixture bench;
    CHECK(bench.session.GetStatistics().lastVersion.empty());
    bench.SendState();
    CHECK(bench.session.GetStatistics().lastVersion == "2.0.0");
    ConnectionMessage message;
    message.header = Header{0, bench.GetNow().wall, "3.0.0" + std::string(100, 'x'), "ACS", "LR01"};
    bench.Deliver(ETopic::Connection, Vda5050Codec().Encode(message, EVda5050Version::Version200));
    CHECK(bench.session.GetStatistics().messagesRefused == 1);
    CHECK(bench.session.GetStatistics().lastVersion == "3.0.0" + std::string(27, 'x'));
}

TEST_CASE("6.5 A will of an earlier connection with another client id that arrives after ONLINE is recognised as old")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.Connect(EConnectionState::ConnectionBroken);
    CHECK_FALSE(bench.session.IsReady());
    bench.SendState();
    CHECK(bench.session.IsReady());
    CHECK(bench.session.GetLink() == EVehicleLink::Online);
    bench.Connect(EConnectionState::Offline);
    bench.SendState(); // the vehicle itself published OFFLINE
    CHECK_FALSE(bench.session.IsReady());
}

TEST_CASE("13 An order is resent until the state shows its ids, and then no more")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    REQUIRE(bench.GetSent(ETopic::Order).size() == 2);
    const OrderMessage resent = bench.GetSentOrder();
    CHECK(resent.nodes == order.nodes);
    CHECK(resent.header.headerID == 1);
    bench.Hold(order, 2);
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 0}});
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N0"});
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).empty());
}

TEST_CASE("13 A vehicle that shows no order any more before it has shown the one sent may have executed it")
{
    MasterSessionFixture bench;
    bench.state.orderID = "order-0";
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(3, 3), bench.GetNow(), bench.Clear()).has_value());
    bench.state.orderID.clear();
    bench.state.lastNodeID = GENERATE("", "N2");
    bench.SendState();
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
}

TEST_CASE("4.2 Without its horizon an order is not finished at the end of its base, and continues with an update")
{
    MasterSessionFixture bench;
    bench.session.SetHorizonOmitted(true);
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(3, 2), bench.GetNow(), bench.Clear()).has_value());
    const OrderMessage sent = bench.GetSentOrder();
    CHECK(sent.nodes.size() == 2);
    CHECK(sent.edges.size() == 1);
    bench.Hold(sent, 0);
    bench.state.orderUpdateID = GENERATE(0U, 5U); // the one sent, or one that this master has not used
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N0", "N1"});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    OrderMessage update = MakeOrder(3, 3);
    update.nodes.erase(update.nodes.begin());
    update.edges.erase(update.edges.begin());
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(bench.GetSentOrder(), 0);
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N2"});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 Resends end after the configured number")
{
    MasterOptions options = MakeMasterOptions();
    options.resendCount = 1;
    MasterSessionFixture bench(options);
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    REQUIRE(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderRejected>(bench.GetOutput())[0].errorType.empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE("13 Nodes are reported once and in order, also when the states between them were lost")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(5, 5);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 4);
    bench.SendState();
    bench.Hold(order, 1);
    bench.SendState();
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N0", "N1", "N2", "N3"});
    bench.Hold(order, 0);
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()).size() == 5);
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 A vehicle with horizon left is waiting, and an order with actions left is not done")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(3);
    OrderMessage order = *builder.MakeOrder(2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    const OrderMessage update = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSentOrder().orderUpdateID == 1);
    bench.Hold(update, 0);
    bench.state.actionStates = {ActionState{"a1", "pick", {}, EActionStatus::Running, {}}};
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 1}});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    bench.state.actionStates[0].actionStatus = EActionStatus::Finished;
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    const auto changes = Pick<ActionChanged>(bench.GetOutput());
    REQUIRE(changes.size() == 2);
    CHECK(changes[1].status == EActionStatus::Finished);
}

TEST_CASE("13 An update waits for the echo of the message before it")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Clear();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSent(ETopic::Order).empty());
    const auto third = bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear());
    REQUIRE_FALSE(third.has_value());
    CHECK(third.error().code == EVda5050Error::UpdatePending);
    bench.Hold(order, 3);
    bench.SendState();
    CHECK(bench.GetSentOrder().orderUpdateID == 1);
}

TEST_CASE("13 An update that does not begin at the decision point is not sent")
{
    MasterSessionFixture bench;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(4, 2), bench.GetNow(), bench.Clear()).has_value());
    OrderBuilder other = MakeBuilder(4);
    REQUIRE(other.MakeOrder(3).has_value());
    const auto result = bench.session.SendOrderUpdate(*other.MakeUpdate(4), bench.GetNow(), bench.Clear());
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().code == EVda5050Error::InvalidOrder);
}

TEST_CASE("4.2 A rejection is recognised by its references, or without references by its type")
{
    const std::vector<ErrorReference> references = GENERATE(
        std::vector<ErrorReference>{{"orderId", "order-1"}, {"orderUpdateId", "0"}},
        std::vector<ErrorReference>{{"topic", "order"}, {"headerId", "0"}},
        std::vector<ErrorReference>{{"nodeId", "N0"}},
        std::vector<ErrorReference>{});
    MasterSessionFixture bench;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    bench.Refuse(ErrorTypes::NO_ROUTE_ERROR, references);
    CHECK(
        Pick<OrderRejected>(bench.GetOutput()) == std::vector{OrderRejected{"order-1", 0, "noRouteError", "because"}});
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE("4.2 Errors of another order, of earlier, of an instant action or of the battery are no rejection")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.Refuse(ErrorTypes::VALIDATION_ERROR, {});
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    bench.SendState();
    bench.Refuse(ErrorTypes::ORDER_UPDATE_ERROR, {{"orderId", "order-0"}, {"orderUpdateId", "0"}});
    bench.Refuse(ErrorTypes::VALIDATION_ERROR, {{"topic", "instantActions"}});
    bench.Refuse("batteryLow", {});
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Sent);
}

TEST_CASE("4.2 After a rejected update the order continues, and the next update has another id")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.SendState();
    const OrderMessage update = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    bench.Refuse(ErrorTypes::ORDER_ERROR, {{"orderId", "order-1"}, {"orderUpdateId", "1"}});
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSentOrder().orderUpdateID == 2);
}

TEST_CASE("5.4 A cancel of an accepted order ends with the vehicle's FINISHED")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 2);
    bench.SendState();
    REQUIRE(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value());
    const auto sent = bench.GetSent(ETopic::InstantActions);
    REQUIRE(sent.size() == 1);
    const auto message = Vda5050Codec().Decode<InstantActionsMessage>(sent[0].payload);
    REQUIRE(message.has_value());
    CHECK(message->actions[0].blockingType == EBlockingType::Hard);
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 2);
    bench.state.actionStates = {
        ActionState{message->actions[0].actionID, "cancelOrder", {}, EActionStatus::Running, {}}};
    bench.SendState();
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).empty());
    bench.state.actionStates[0].actionStatus = EActionStatus::Finished;
    bench.state.nodeStates.clear();
    bench.SendState();
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderLost>(bench.GetOutput()).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE("5.4 A cancel of an order that the vehicle never saw ends it, and it is not sent again")
{
    MasterSessionFixture bench;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value());
    const auto message =
        Vda5050Codec().Decode<InstantActionsMessage>(bench.GetSent(ETopic::InstantActions).back().payload);
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).empty());
    bench.Refuse(ErrorTypes::NO_ORDER_TO_CANCEL, {{"actionId", message->actions[0].actionID}});
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).size() == 1);
    CHECK_FALSE(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value());
}

TEST_CASE("13 A vehicle that restarts without the order, or cleared it, has lost it")
{
    const bool bRestarted = GENERATE(true, false);
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 2);
    bench.SendState();
    bench.state.orderID = bRestarted ? "" : "order-1";
    bench.state.nodeStates.clear();
    bench.SendState();
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE("4.6 A vehicle without a state for longer than interval plus margin is reported as silent, once")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.Wait(std::chrono::seconds(20), EMasterTimer::ResendOrder);
    bench.SendState();
    bench.Clear();
    bench.Wait(std::chrono::seconds(15), EMasterTimer::Silence);
    CHECK(Pick<VehicleSilent>(bench.GetOutput()).empty());
    CHECK(
        Pick<StartMasterTimer>(bench.GetOutput())
        == std::vector{StartMasterTimer{EMasterTimer::Silence, std::chrono::seconds(20)}});
    bench.Wait(std::chrono::seconds(20), EMasterTimer::Silence);
    CHECK(Pick<VehicleSilent>(bench.GetOutput()).size() == 1);
    CHECK_FALSE(bench.session.IsReady());
    bench.SendState();
    CHECK(bench.session.IsReady());
}

TEST_CASE("2 A state older than the last one is ignored; headerIds that restart are accepted")
{
    MasterSessionFixture bench;
    bench.BeReady();
    StateMessage old = bench.state;
    old.header.headerID = 0;
    old.header.timestamp -= std::chrono::seconds(1);
    bench.Deliver(ETopic::State, Vda5050Codec().Encode(old, EVda5050Version::Version200));
    CHECK(bench.session.GetStatistics().statesIgnored == 1);
    old.header.timestamp += std::chrono::seconds(2);
    bench.Deliver(ETopic::State, Vda5050Codec().Encode(old, EVda5050Version::Version200));
    CHECK(bench.session.GetStatistics().statesReceived == 2);
}

TEST_CASE("2 A retained state brings no vehicle online and is no evidence about an order")
{
    MasterSessionFixture bench;
    StateMessage state;
    state.header = Header{7, bench.GetNow().wall, "2.0.0", "ACS", "LR01"};
    const MqttMessage message{
        BuildTopic(MakeAddress(), ETopic::State),
        Vda5050Codec().Encode(state, EVda5050Version::Version200),
        1,
        true};
    bench.session.OnMessage(message, bench.GetNow(), bench.Clear());
    CHECK(bench.GetOutput().empty());
    CHECK(bench.session.GetLink() == EVehicleLink::Unknown);
    CHECK(bench.session.GetStateOrNull() == nullptr);
    CHECK(bench.session.GetStatistics().retainedIgnored == 1);
    MqttMessage live = message;
    live.bRetained = false;
    bench.session.OnMessage(live, bench.GetNow(), bench.Clear());
    CHECK(bench.session.GetLink() == EVehicleLink::Online);
    CHECK(bench.session.IsReady());
}

TEST_CASE("6 After an outage of the master's link the retained ONLINE alone makes no vehicle ready")
{
    MasterSessionFixture bench;
    bench.BeReady();
    REQUIRE(bench.session.IsReady());
    bench.session.OnLinkDown(bench.GetNow(), bench.Clear());
    bench.session.OnLinkUp(bench.GetNow(), bench.Clear());
    bench.Connect(EConnectionState::Online);
    CHECK(bench.session.GetLink() == EVehicleLink::Online);
    CHECK_FALSE(bench.session.IsReady());
    CHECK_FALSE(bench.session.CanTakeOrder());
    bench.SendState();
    CHECK(bench.session.CanTakeOrder());
}

TEST_CASE("3.1 A header of another vehicle or another major version is refused; empty names are tolerated")
{
    MasterSessionFixture bench;
    bench.BeReady();
    StateMessage state = bench.state;
    const auto say = [&](const std::string& version, const std::string& manufacturer, const std::string& serial) {
        state.header = Header{99, bench.GetNow().wall + std::chrono::seconds(1), version, manufacturer, serial};
        bench.Clear();
        bench.Deliver(ETopic::State, Vda5050Codec().Encode(state, EVda5050Version::Version200));
        return Pick<MessageRefused>(bench.GetOutput()).size() == 1;
    };
    CHECK(say("2.0.0", "OTHER", "LR01"));
    CHECK(say("2.0.0", "ACS", "LR02"));
    CHECK(say("3.0.0", "ACS", "LR01"));
    CHECK(Pick<MessageRefused>(bench.GetOutput())[0].error.code == EVda5050Error::UnsupportedVersion);
    CHECK(bench.session.GetStatistics().messagesRefused == 3);
    CHECK(bench.session.GetStatistics().lastRefusal == "state: version: expected 2.x, found 3.0.0");
    CHECK(bench.session.GetStatistics().statesReceived == 1);
    CHECK_FALSE(say("2.1.0", "", ""));
    CHECK(bench.session.GetStatistics().statesReceived == 2);
}

TEST_CASE("13 Broken payloads are counted and reported; nothing else happens")
{
    MasterSessionFixture bench;
    bench.BeReady();
    for (const ETopic topic : {ETopic::State, ETopic::Connection, ETopic::Visualization, ETopic::Factsheet})
    {
        bench.Deliver(topic, R"({"headerId":"NaN")");
    }
    CHECK(Pick<MessageRefused>(bench.GetOutput()).size() == 4);
    CHECK(bench.session.GetStatistics().messagesRefused == 4);
    CHECK(bench.GetOutput().size() == 4);
}

TEST_CASE("13 No order is sent to a vehicle that is not ready or has an order")
{
    MasterSessionFixture bench;
    const OrderMessage order = MakeOrder(2, 2);
    CHECK(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).error().code == EVda5050Error::VehicleNotReady);
    bench.BeReady();
    bench.state.operatingMode = EOperatingMode::Manual;
    bench.SendState();
    CHECK(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).error().code == EVda5050Error::VehicleNotReady);
    bench.state.operatingMode = EOperatingMode::Automatic;
    bench.SendState();
    OrderMessage broken = order;
    broken.edges.clear();
    CHECK(bench.session.SendOrder(broken, bench.GetNow(), bench.Clear()).error().code == EVda5050Error::InvalidOrder);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).error().code == EVda5050Error::OrderActive);
}

} // namespace ACS::VDA5050::Test

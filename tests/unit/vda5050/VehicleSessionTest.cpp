#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>

namespace ACS::VDA5050::Test
{

namespace
{

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("4.2 A new order is accepted when none runs and the vehicle is on its first node")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(4, 2));
    CHECK(Pick<OrderTaken>(bench.GetOutput()) == std::vector{OrderTaken{"order-1", 0, false}});
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.orderID == "order-1");
    CHECK(state.lastNodeID == "N0");
    CHECK(ListNodes(state) == Names{"N1", "N2", "N3"});
    CHECK(state.edgeStates.size() == 3);
    CHECK(state.errors.empty());
}

TEST_CASE("4.2 A payload that is not an order is rejected with validationError, and the running order continues")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(3, 3));
    const char* payload = GENERATE(
        "{",
        "[]",
        "null",
        R"({"headerId":"x"})",
        R"({"headerId":7,"timestamp":"2025-01-01T00:00:00Z","version":"2.0.0","manufacturer":"ACS",)"
        R"("serialNumber":"LR01","orderId":"o","orderUpdateId":-1,"nodes":[],"edges":[]})");
    bench.Clear();
    bench.Payload(ETopic::Order, payload);
    CHECK(bench.HasError(ErrorTypes::VALIDATION_ERROR));
    CHECK(bench.GetPublishedState().orderID == "order-1");
    CHECK(bench.GetPublishedState().nodeStates.size() == 2);
}

TEST_CASE("4.2 An order with a broken structure is refused with validationError and its references")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[1].sequenceID = 7;
    bench.Order(order);
    const StateMessage state = bench.GetPublishedState();
    REQUIRE_FALSE(state.errors.empty());
    CHECK(state.errors[0].errorType == ErrorTypes::VALIDATION_ERROR);
    CHECK(*FindReferenceOrNull(state.errors[0], "orderId") == "order-1");
    CHECK(*FindReferenceOrNull(state.errors[0], "topic") == "order");
    CHECK(state.orderID.empty());
}

TEST_CASE("4.2 An order with an action that the vehicle cannot perform is rejected with orderError")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    AgvAction known;
    known.actionType = "drop";
    known.actionScopes = {EActionScope::Node};
    options.factsheet.protocolFeatures.agvActions = {known};
    VehicleSessionFixture bench(options);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, "pick"));
    bench.Order(order);
    CHECK(bench.HasError(ErrorTypes::ORDER_ERROR));
    CHECK(bench.GetPublishedState().orderID.empty());
}

TEST_CASE("4.2 A second order while one runs, its horizon too, is refused with orderUpdateError")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(3, 1));
    bench.Order(MakeOrder(2, 2, "order-2"));
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    CHECK(bench.GetPublishedState().orderID == "order-1");
}

TEST_CASE("4.2 An order whose first node is out of reach is rejected with noRouteError")
{
    VehicleSessionFixture bench;
    bench.StandAt(3.0);
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.HasError(ErrorTypes::NO_ROUTE_ERROR));
    OrderMessage wide = MakeOrder(2, 2, "order-2");
    wide.nodes[0].nodePosition->allowedDeviationXY = 4.0;
    bench.Order(wide);
    CHECK(bench.GetPublishedState().orderID == "order-2");
    CHECK(bench.GetPublishedState().errors.empty());
}

TEST_CASE("4.2 A lower orderUpdateId is refused, an equal one is discarded without an error")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.orderUpdateID = 2;
    bench.Order(order);
    bench.Clear();
    bench.Order(order);
    CHECK(bench.GetPublishedState().errors.empty());
    CHECK(Pick<OrderTaken>(bench.GetOutput()).empty());
    CHECK(bench.GetPublishedStates().size() == 1); // the echo, once more
    order.orderUpdateID = 1;
    bench.Order(order);
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    CHECK(bench.GetPublishedState().orderUpdateID == 2);
}

TEST_CASE("4.2 An update that does not begin at the decision point is rejected, and the order continues")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(5, 2));
    OrderMessage update = MakeUpdate(5, 3, 4);
    bench.Order(update);
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    CHECK(bench.GetPublishedState().orderUpdateID == 0);
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1", "N2", "N3", "N4"});
}

TEST_CASE("4.2 The order of another vehicle, a retained one, and an empty message that removes one are ignored")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.header = Header{0, bench.GetNow().wall, "2.0.0", "ACS", "LR99"};
    const std::string foreign = Vda5050Codec().Encode(order, EVda5050Version::Version200);
    bench.Payload(ETopic::Order, foreign);
    order.header.serialNumber = "LR01";
    bench.Payload(ETopic::Order, Vda5050Codec().Encode(order, EVda5050Version::Version200), true);
    bench.Payload(ETopic::Order, "");
    bench.Payload(ETopic::InstantActions, "");
    CHECK(Pick<MessageIgnored>(bench.GetOutput()).size() == 4);
    CHECK(bench.GetSession().GetState().orderID.empty());
    CHECK(bench.GetSession().GetState().errors.empty());
}

TEST_CASE("4.3 An update extends the base at the decision point and replaces the horizon")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(5, 2));
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].bStopAtNode);
    CHECK_FALSE(Pick<DriveTo>(bench.GetOutput())[0].next.has_value());
    bench.Clear();
    bench.Order(MakeUpdate(4, 2, 3));
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.orderUpdateID == 1);
    CHECK(ListNodes(state) == Names{"N1", "N2", "N3"});
    CHECK(state.nodeStates[1].bReleased);
    CHECK_FALSE(state.nodeStates[2].bReleased);
    // On the way to N1 the session reports that the vehicle need not stop there.
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].node.nodeID == "N1");
    CHECK_FALSE(Pick<DriveTo>(bench.GetOutput())[0].bStopAtNode);
    const std::optional<NextLeg> next = Pick<DriveTo>(bench.GetOutput())[0].next;
    REQUIRE(next.has_value());
    CHECK(next->edge.edgeID == "E1");
    CHECK(next->edge.startNodeID == "N1");
    CHECK(next->node.nodeID == "N2");
}

TEST_CASE("4.3 After the base is done an update that begins at the last node is accepted")
{
    VehicleSessionFixture bench;
    OrderBuilder builder = MakeBuilder(2);
    bench.Order(*builder.MakeOrder(2));
    bench.Reach(2);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    OrderNode more;
    more.nodeID = "N2";
    OrderEdge edge;
    edge.edgeID = "E1";
    REQUIRE(builder.Append({more}, {edge}).has_value());
    bench.Clear();
    bench.Order(*builder.MakeUpdate(3));
    CHECK(bench.GetPublishedState().orderUpdateID == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
}

TEST_CASE("4.4 A traversal is one state: node and edge gone, lastNode set, the node's actions begun")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    bench.Order(order);
    bench.Clear();
    bench.Reach(2);
    REQUIRE(bench.GetPublishedStates().size() == 1);
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.lastNodeID == "N1");
    CHECK(state.lastNodeSequenceID == 2);
    CHECK(ListNodes(state) == Names{"N2"});
    CHECK(state.edgeStates.size() == 1);
    CHECK(bench.GetStartedActions() == Names{"a1"});
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    VehicleActions out;
    CHECK_FALSE(bench.GetSession().TryReachNode({2}, bench.GetNow(), out));
}

TEST_CASE("4.4 The next edge is entered when the vehicle moves on; its actions wait until then")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[1].actions.push_back(MakeAction("n", EBlockingType::Soft));
    order.edges[1].actions.push_back(MakeAction("e", EBlockingType::None));
    bench.Order(order);
    bench.Reach(2);
    CHECK(bench.GetStartedActions() == Names{"n"});
    CHECK(bench.GetStatus("e") == EActionStatus::Waiting);
    bench.Status("n", EActionStatus::Running);
    bench.Status("n", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == Names{"n", "e"});
    CHECK(Pick<DriveTo>(bench.GetOutput()).back().node.nodeID == "N2");
    bench.Status("e", EActionStatus::Running);
    bench.Reach(4);
    CHECK(Pick<StopAction>(bench.GetOutput()) == std::vector{StopAction{"e", true}});
}

TEST_CASE("4.5 An order is complete when nothing is left to reach and every action ended; its ids stay")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::None));
    bench.Order(order);
    bench.Reach(2);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).empty());
    bench.Status("a1", EActionStatus::Running);
    bench.Status("a1", EActionStatus::Failed);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.orderID == "order-1");
    CHECK(state.actionStates.size() == 1);
    bench.StandAt(10.0);
    OrderMessage next = MakeOrder(1, 1, "order-2");
    next.nodes[0].nodePosition->x = 10.0;
    bench.Order(next);
    CHECK(bench.GetPublishedState().orderID == "order-2");
    CHECK(bench.GetPublishedState().actionStates.empty());
}

TEST_CASE("4.5 A base that is done with a horizon left is no completed order")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(3, 2));
    bench.Reach(2);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).empty());
    CHECK(bench.GetPublishedState().bNewBaseRequest == true);
}

TEST_CASE("4.6 States that are due close together are merged, and one comes after the interval at the latest")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.minimumStateInterval = std::chrono::milliseconds(100);
    VehicleSessionFixture bench(options);
    bench.Advance(std::chrono::milliseconds(40));
    bench.Drive(true);
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.GetPublishedStates().empty());
    const auto timers = Pick<StartVehicleTimer>(bench.GetOutput());
    REQUIRE(timers.size() == 1);
    CHECK(timers[0] == StartVehicleTimer{EVehicleTimer::MinimumStateInterval, std::chrono::milliseconds(60)});
    bench.Advance(std::chrono::milliseconds(60));
    VehicleActions out;
    bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
    CHECK(Pick<PublishMessage>(out).size() == 1);
    CHECK(
        Pick<StartVehicleTimer>(out).back()
        == StartVehicleTimer{EVehicleTimer::MaximumStateInterval, std::chrono::seconds(30)});
    CheckPublished(out);
    out.clear();
    bench.Advance(std::chrono::seconds(30));
    bench.GetSession().OnTimer(EVehicleTimer::MaximumStateInterval, bench.GetNow(), out);
    CheckPublished(out);
    CHECK(Pick<PublishMessage>(out).size() == 1);
}

TEST_CASE("5.2 Actions run by their blocking types, in the order of the array")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {
        MakeAction("none1", EBlockingType::None),
        MakeAction("soft", EBlockingType::Soft),
        MakeAction("hard", EBlockingType::Hard),
        MakeAction("none2", EBlockingType::None)};
    bench.Order(order);
    CHECK(bench.GetStartedActions() == Names{"none1", "soft"});
    bench.Status("none1", EActionStatus::Running);
    bench.Status("soft", EActionStatus::Running);
    bench.Status("soft", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == Names{"none1", "soft"});
    bench.Status("none1", EActionStatus::Failed);
    CHECK(bench.GetStartedActions() == Names{"none1", "soft", "hard"});
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    bench.Status("hard", EActionStatus::Running);
    bench.Status("hard", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == Names{"none1", "soft", "hard", "none2"});
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.3 A pause is finished when the vehicle is stationary, and stopPause lets it drive on")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Clear();
    bench.Instant("startPause", "p1");
    CHECK(Pick<StopDriving>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetStatus("p1") == EActionStatus::Running);
    CHECK(bench.GetPublishedState().bPaused == false);
    bench.Drive(false);
    CHECK(bench.GetStatus("p1") == EActionStatus::Finished);
    CHECK(bench.GetPublishedState().bPaused == true);
    bench.Instant("startPause", "p2");
    CHECK(bench.GetStatus("p2") == EActionStatus::Finished);
    bench.Clear();
    bench.Instant("stopPause", "p3");
    CHECK(bench.GetStatus("p3") == EActionStatus::Finished);
    CHECK(bench.GetPublishedState().bPaused == false);
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.4 A cancel fails waiting actions, stops running ones, and is finished when the vehicle is stationary")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 2);
    order.nodes[0].actions.push_back(MakeAction("runs", EBlockingType::None));
    order.nodes[2].actions.push_back(MakeAction("waits", EBlockingType::Hard));
    bench.Order(order);
    bench.Status("runs", EActionStatus::Running);
    bench.Drive(true);
    bench.Clear();
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("waits") == EActionStatus::Failed);
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    CHECK(Pick<StopAction>(bench.GetOutput()) == std::vector{StopAction{"runs", false}});
    CHECK(Pick<StopDriving>(bench.GetOutput()).size() == 1);
    bench.Order(MakeUpdate(3, 2, 3));
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    bench.Drive(false);
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    bench.Status("runs", EActionStatus::Failed);
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.nodeStates.empty());
    CHECK(state.edgeStates.empty());
    CHECK(state.orderID == "order-1");
    CHECK(state.lastNodeID == "N0");
    CHECK(Pick<OrderCleared>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.4 A vehicle that stops only on nodes drives to the next one first")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.bStopsBetweenNodes = false;
    VehicleSessionFixture bench(options);
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[1].actions.push_back(MakeAction("late", EBlockingType::None));
    bench.Order(order);
    bench.Drive(true);
    bench.Clear();
    bench.Instant("cancelOrder", "c1");
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1"});
    CHECK(bench.GetPublishedState().edgeStates.empty());
    CHECK(Pick<DriveTo>(bench.GetOutput()).back().bStopAtNode);
    bench.Reach(2);
    bench.Drive(false);
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(bench.GetPublishedState().lastNodeID == "N1");
    CHECK(bench.GetStartedActions().empty());
}

TEST_CASE("5.4 A cancel without an order fails with noOrderToCancel and the actionId")
{
    VehicleSessionFixture bench;
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("c1") == EActionStatus::Failed);
    const StateMessage state = bench.GetPublishedState();
    REQUIRE(state.errors.size() == 1);
    CHECK(state.errors[0].errorType == ErrorTypes::NO_ORDER_TO_CANCEL);
    CHECK(*FindReferenceOrNull(state.errors[0], "actionId") == "c1");
}

TEST_CASE("5.4.7 After a cancel between two nodes an order must begin at the vehicle's position or reach it")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.StandAt(5.0);
    bench.Instant("cancelOrder", "c1");
    bench.Drive(false);
    bench.Order(MakeOrder(2, 2, "order-2"));
    CHECK(bench.HasError(ErrorTypes::NO_ROUTE_ERROR));
    OrderMessage wide = MakeOrder(2, 2, "order-3");
    wide.nodes[0].nodePosition->allowedDeviationXY = 6.0;
    bench.Order(wide);
    CHECK(bench.GetPublishedState().orderID == "order-3");
}

TEST_CASE(
    "5.6 stateRequest and factsheetRequest are answered, an unknown instant action fails, a repeated id is ignored")
{
    VehicleSessionFixture bench;
    bench.Instant("stateRequest", "i1");
    CHECK(bench.GetStatus("i1") == EActionStatus::Finished);
    CHECK(bench.GetPublishedStates().size() == 1);
    bench.Clear();
    bench.Instant("factsheetRequest", "i2");
    const auto published = Pick<PublishMessage>(bench.GetOutput());
    REQUIRE(published.size() == 2);
    CHECK(published[0].message.topic == BuildTopic(MakeAddress(), ETopic::Factsheet));
    CHECK(published[0].message.bRetained);
    bench.Instant("makeCoffee", "i3");
    CHECK(bench.GetStatus("i3") == EActionStatus::Failed);
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
    bench.Instant("makeCoffee", "i3");
    CHECK(bench.GetSession().GetState().actionStates.size() == 3);
}

TEST_CASE("6 The vehicle publishes ONLINE, sets a will, and publishes OFFLINE at the end; all retained with QoS 1")
{
    VehicleSession session(VehicleSessionFixture::MakeOptions());
    Testing::ManualClock clock;
    const MqttMessage will = session.MakeWill(clock.GetNow()).message;
    VehicleActions out;
    session.OnLinkUp(clock.GetNow(), out);
    session.Leave(clock.GetNow(), out);
    CheckPublished(out);
    Testing::CheckValid(will.topic, will.payload);
    std::vector<MqttMessage> messages{will};
    for (const PublishMessage& publish : Pick<PublishMessage>(out))
    {
        if (publish.message.topic == "uagv/v2/ACS/LR01/connection")
        {
            messages.push_back(publish.message);
        }
    }
    REQUIRE(messages.size() == 3);
    Vda5050Codec codec;
    std::vector<EConnectionState> states;
    for (const MqttMessage& message : messages)
    {
        CHECK(message.qos == 1);
        CHECK(message.bRetained);
        const auto decoded = codec.Decode<ConnectionMessage>(message.payload);
        REQUIRE(decoded.has_value());
        states.push_back(decoded->connectionState);
        CHECK(decoded->header.headerID == states.size() - 1);
    }
    CHECK(
        states == std::vector{EConnectionState::ConnectionBroken, EConnectionState::Online, EConnectionState::Offline});
}

TEST_CASE("8.6 MANUAL clears the order and no other is accepted")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    bench.Order(order);
    VehicleActions out;
    bench.GetSession().OnOperatingMode(EOperatingMode::Manual, bench.GetNow(), out);
    CheckPublished(out);
    CHECK(Pick<StopDriving>(out).size() == 1);
    CHECK(bench.GetSession().GetState().nodeStates.empty());
    CHECK(bench.GetStatus("a1") == EActionStatus::Failed);
    bench.Order(MakeOrder(2, 2, "order-2"));
    CHECK(bench.HasError(ErrorTypes::ORDER_ERROR));
    CHECK(bench.GetSession().GetState().orderID == "order-1");
}

TEST_CASE("3.5 Visualization has the position at its own rate")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.visualizationInterval = std::chrono::milliseconds(200);
    VehicleSessionFixture bench(options);
    VehicleActions out;
    bench.GetSession().OnTimer(EVehicleTimer::Visualization, bench.GetNow(), out);
    CheckPublished(out);
    REQUIRE(Pick<PublishMessage>(out).size() == 1);
    CHECK(Pick<PublishMessage>(out)[0].message.topic == "uagv/v2/ACS/LR01/visualization");
    CHECK(
        Pick<StartVehicleTimer>(out)
        == std::vector{StartVehicleTimer{EVehicleTimer::Visualization, std::chrono::milliseconds(200)}});
}

} // namespace ACS::VDA5050::Test

#include "MasterSessionFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <array>

namespace ACS::VDA5050::Test
{

namespace
{

/// A vehicle that can pick on nodes and take pictures at any time, in numbers that the test changes.
FactsheetMessage MakeFactsheet()
{
    FactsheetMessage factsheet;
    factsheet.header = Header{0, {}, "2.0.0", "ACS", "LR01"};
    AgvAction& pick = factsheet.protocolFeatures.agvActions.emplace_back();
    pick.actionType = "pickAll";
    pick.actionScopes = {EActionScope::Node};
    AgvAction& picture = factsheet.protocolFeatures.agvActions.emplace_back();
    picture.actionType = "takePicture";
    picture.actionScopes = {EActionScope::Instant};
    picture.blockingTypes = {EBlockingType::Soft};
    return factsheet;
}

void DeliverFactsheet(MasterSessionFixture& bench, const FactsheetMessage& factsheet)
{
    bench.Deliver(ETopic::Factsheet, Vda5050Codec().Encode(factsheet, EVda5050Version::Version210));
    REQUIRE(bench.session.GetFactsheetOrNull() != nullptr);
}

Core::Result<void> Send(MasterSessionFixture& bench, const OrderMessage& order)
{
    return bench.session.SendOrder(order, bench.GetNow(), bench.Clear());
}

} // namespace

TEST_CASE("3.7 An order with an action that the factsheet does not list is not sent, and the error names the action")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, "pickAll"));
    order.edges[0].actions.push_back(MakeAction("a2", EBlockingType::None, "takePicture"));
    DeliverFactsheet(bench, MakeFactsheet());
    const auto refused = Send(bench, order);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EVda5050Error::NotSupported);
    CHECK_THAT(Core::Describe(refused.error()), Catch::Contains("takePicture"));
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(bench.session.CanTakeOrder());
    order.edges[0].actions.clear();
    CHECK(Send(bench, order).has_value());
}

TEST_CASE("3.7 Tolerances that are not listed are left out; an order with a limit that is not listed is rejected")
{
    MasterSessionFixture bench;
    bench.BeReady();
    FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolFeatures.optionalParameters = {
        OptionalParameter{"order.nodes.nodePosition", EParameterSupport::Supported, {}}};
    DeliverFactsheet(bench, factsheet);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].nodePosition->allowedDeviationXY = 0.5;
    order.edges[0].length = 10.0;
    order.edges[0].maxSpeed = 1.0;
    const auto refused = Send(bench, order);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EVda5050Error::NotSupported);
    CHECK(refused.error().path == "order.edges.maxSpeed");
    order.edges[0].maxSpeed.reset();
    REQUIRE(Send(bench, order).has_value());
    CHECK_FALSE(bench.GetSentOrder().nodes[1].nodePosition->allowedDeviationXY.has_value());
    CHECK_FALSE(bench.GetSentOrder().edges[0].length.has_value());
}

TEST_CASE("3.7 A member is supported where it or one inside it is listed, and where there is no list")
{
    FactsheetMessage factsheet = MakeFactsheet();
    CHECK(IsSupported(factsheet, "order.edges.trajectory"));
    factsheet.protocolFeatures.optionalParameters.emplace();
    CHECK_FALSE(IsSupported(factsheet, "order.edges.trajectory"));
    factsheet.protocolFeatures.optionalParameters->push_back(
        {"order.nodes.nodePosition.theta", EParameterSupport::Supported, {}});
    CHECK(IsSupported(factsheet, "order.nodes.nodePosition.theta"));
    CHECK(IsSupported(factsheet, "order.nodes.nodePosition"));
    CHECK_FALSE(IsSupported(factsheet, "order.nodes.nodePos"));
    CHECK_FALSE(IsSupported(factsheet, "order.nodes.nodePosition.theta.more"));
    CHECK_FALSE(IsSupported(factsheet, "order.nodes.nodePosition.allowedDeviationXY"));
}

TEST_CASE("3.7 An absent list of optional parameters and an empty one remain different when encoded and decoded")
{
    Vda5050Codec codec;
    FactsheetMessage factsheet = MakeFactsheet();
    const auto absent = codec.Decode<FactsheetMessage>(codec.Encode(factsheet, EVda5050Version::Version210));
    REQUIRE(absent.has_value());
    CHECK_FALSE(absent->protocolFeatures.optionalParameters.has_value());
    factsheet.protocolFeatures.optionalParameters.emplace();
    const auto empty = codec.Decode<FactsheetMessage>(codec.Encode(factsheet, EVda5050Version::Version210));
    REQUIRE(empty.has_value());
    REQUIRE(empty->protocolFeatures.optionalParameters.has_value());
    CHECK(empty->protocolFeatures.optionalParameters->empty());
}

TEST_CASE("3.7 With an empty list of optional parameters an order has no tolerances, and limits are rejected")
{
    MasterSessionFixture bench;
    bench.BeReady();
    FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolFeatures.optionalParameters.emplace();
    DeliverFactsheet(bench, factsheet);
    OrderMessage order = MakeOrder(2, 2);
    for (OrderNode& node : order.nodes)
    {
        node.nodePosition.reset();
    }
    order.edges[0].length = 10.0;
    order.edges[0].maxSpeed = 1.0;
    const auto refused = Send(bench, order);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().path == "order.edges.maxSpeed");
    order.edges[0].maxSpeed.reset();
    REQUIRE(Send(bench, order).has_value());
    CHECK_FALSE(bench.GetSentOrder().edges[0].length.has_value());
}

TEST_CASE("3.7 An order that lacks a member required by the factsheet, or exceeds a size in it, is rejected")
{
    MasterSessionFixture bench;
    bench.BeReady();
    FactsheetMessage factsheet = MakeFactsheet();
    OrderMessage order = MakeOrder(3, 3);
    SECTION("a required member")
    {
        factsheet.protocolFeatures.optionalParameters = {
            OptionalParameter{"order.nodes.nodePosition.theta", EParameterSupport::Required, {}}};
    }
    SECTION("nodes")
    {
        factsheet.protocolLimits.maxArrayLengths.orderNodes = 2;
    }
    SECTION("bytes")
    {
        factsheet.protocolLimits.maxStringLengths.message = 200;
    }
    DeliverFactsheet(bench, factsheet);
    const auto refused = Send(bench, order);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EVda5050Error::NotSupported);
    MasterOptions careless = MakeMasterOptions();
    careless.bFactsheetObeyed = false;
    MasterSessionFixture other(careless);
    other.BeReady();
    DeliverFactsheet(other, factsheet);
    CHECK(Send(other, order).has_value());
}

TEST_CASE("5.6 Instant actions are checked against the factsheet, except those that every master needs")
{
    MasterSessionFixture bench;
    bench.BeReady();
    DeliverFactsheet(bench, MakeFactsheet());
    const auto send = [&](std::string type) {
        return bench.session.SendInstantAction(
            MakeAction({}, EBlockingType::None, std::move(type)),
            bench.GetNow(),
            bench.Clear());
    };
    const auto refused = send("pickAll");
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EVda5050Error::NotSupported);
    CHECK(send("startPause").has_value());
    REQUIRE(send("takePicture").has_value());
    const auto message =
        Vda5050Codec().Decode<InstantActionsMessage>(bench.GetSent(ETopic::InstantActions).back().payload);
    CHECK(message->actions[0].blockingType == EBlockingType::Soft); // the one that the vehicle takes
}

TEST_CASE("13 The master keeps minOrderInterval between order messages and the limit of instant actions")
{
    MasterSessionFixture bench;
    bench.BeReady();
    FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolLimits.timing.minOrderInterval = 5.0;
    factsheet.protocolLimits.maxArrayLengths.instantActions = 1;
    DeliverFactsheet(bench, factsheet);
    OrderBuilder builder = MakeBuilder(3);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(Send(bench, order).has_value());
    CHECK(bench.GetSent(ETopic::Order).size() == 1);
    bench.Hold(order, 2);
    bench.SendState();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(
        Pick<StartMasterTimer>(bench.GetOutput())
        == std::vector{StartMasterTimer{EMasterTimer::ResendOrder, std::chrono::seconds(3)}});
    CHECK(Pick<OrderDelayed>(bench.GetOutput()) == std::vector{OrderDelayed{"order-1", 1, std::chrono::seconds(3)}});
    bench.Clear();
    bench.Wait(std::chrono::seconds(3), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).size() == 1);
    CHECK(bench.session.GetStatistics().ordersResent == 0);
    bench.Wait(std::chrono::seconds(2),
               EMasterTimer::ResendOrder); // a delayed resend is not reported
    CHECK(Pick<OrderDelayed>(bench.GetOutput()).empty());

    for (int i = 0; i < 2; ++i)
    {
        REQUIRE(
            bench.session
                .SendInstantAction(MakeAction({}, EBlockingType::None, "takePicture"), bench.GetNow(), bench.Clear())
                .has_value());
    }
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 2);
}

TEST_CASE("3.7 A factsheet with an interval below 0 or above a day is rejected")
{
    struct Row
    {
        double interval;
        bool bTaken;
    };
    const Row row = GENERATE(Row{1e300, false}, Row{86'400.5, false}, Row{-0.5, false}, Row{86'400.0, true});
    CAPTURE(row.interval);
    const std::size_t member = GENERATE(as<std::size_t>(), 0, 1, 2, 3);
    FactsheetMessage factsheet = MakeFactsheet();
    ProtocolTiming& timing = factsheet.protocolLimits.timing;
    timing.defaultStateInterval = 1.0;
    timing.visualizationInterval = 1.0;
    const std::array<double*, 4> members{
        &timing.minOrderInterval,
        &timing.minStateInterval,
        &*timing.defaultStateInterval,
        &*timing.visualizationInterval};
    *members.at(member) = row.interval;
    MasterSessionFixture bench;
    bench.Deliver(ETopic::Factsheet, Vda5050Codec().Encode(factsheet, EVda5050Version::Version210));
    CHECK((bench.session.GetFactsheetOrNull() != nullptr) == row.bTaken);
    CHECK(Pick<MessageRefused>(bench.GetOutput()).size() == (row.bTaken ? 0 : 1));
}

TEST_CASE("3.7 A generated short id that is already in use is generated again")
{
    MasterSessionFixture bench;
    FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolLimits.maxStringLengths.identifier = 1;
    DeliverFactsheet(bench, factsheet);
    bench.BeReady();
    for (int i = 0; i < 8; ++i)
    {
        bench.state.actionStates.push_back(
            ActionState{std::to_string(i), "startPause", {}, EActionStatus::Finished, {}});
    }
    bench.SendState();
    for (int i = 0; i < 2; ++i)
    {
        const auto sent = bench.session.SendInstantAction(
            MakeAction({}, EBlockingType::None, "startPause"),
            bench.GetNow(),
            bench.Clear());
        REQUIRE(sent);
        CHECK(bench.GetSent(ETopic::InstantActions).size() == 1);
    }
}

TEST_CASE("4.6 A vehicle that announces a longer state interval counts as silent only after that interval")
{
    MasterSessionFixture bench;
    FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolLimits.timing.defaultStateInterval = 60.0;
    DeliverFactsheet(bench, factsheet);
    bench.BeReady();
    bench.Wait(std::chrono::seconds(64), EMasterTimer::Silence);
    CHECK(Pick<VehicleSilent>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(1), EMasterTimer::Silence);
    CHECK(Pick<VehicleSilent>(bench.GetOutput()).size() == 1);
}

} // namespace ACS::VDA5050::Test

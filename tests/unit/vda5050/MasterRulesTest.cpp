#include "MasterSessionFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// An accepted order over four nodes, two of them released, and the builder with the rest of its route.
OrderBuilder Run(MasterSessionFixture& bench)
{
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.SendState();
    REQUIRE(bench.session.GetOrderPhase() == EOrderPhase::Active);
    return builder;
}

Core::Result<std::string> SendAction(MasterSessionFixture& bench, std::string actionID, std::string actionType)
{
    return bench.session.SendInstantAction(
        MakeAction(std::move(actionID), EBlockingType::None, std::move(actionType)),
        bench.GetNow(),
        bench.Clear());
}

std::string GetSentActionID(const MasterSessionFixture& bench)
{
    const auto message =
        Vda5050Codec().Decode<InstantActionsMessage>(bench.GetSent(ETopic::InstantActions).back().payload);
    REQUIRE(message.has_value());
    return message->actions.back().actionID;
}

void PublishFactsheet(MasterSessionFixture& bench, FactsheetMessage factsheet)
{
    factsheet.header = Header{0, {}, "2.0.0", "ACS", "LR01"};
    bench.Deliver(ETopic::Factsheet, Vda5050Codec().Encode(factsheet, EVda5050Version::Version210));
    REQUIRE(bench.session.GetFactsheetOrNull() != nullptr);
}

} // namespace

TEST_CASE("4.2 Which errors about the running order reject an update")
{
    struct Row
    {
        std::string_view type;
        std::vector<ErrorReference> references;
        bool bRejection;
    };
    const Row row = GENERATE(
        Row{"actionError", {{"orderId", "order-1"}, {"actionId", "a1"}}, false},
        Row{"blockedByObstacle", {{"orderId", "order-1"}}, false},
        Row{"orderUpdateError", {{"orderId", "order-1"}, {"orderUpdateId", "0"}}, false},
        Row{"orderUpdateError", {{"orderId", "order-1"}}, true},
        Row{"badHorizon", {{"orderId", "order-1"}, {"orderUpdateId", "1"}}, true},
        Row{"badHorizon", {{"topic", "order"}, {"orderId", "order-1"}}, true},
        Row{"badHorizon", {{"topic", "order"}, {"headerId", "1"}}, true},
        Row{"badHorizon", {{"topic", "instantAction"}, {"orderId", "order-1"}}, false},
        Row{"actionError", {{"topic", "order"}, {"actionId", "a1"}, {"nodeId", "N1"}}, false},
        Row{"outsideOfCorridor", {{"topic", "order"}, {"edgeId", "E1"}}, false},
        Row{"badHorizon", {{"topic", "order"}}, false},
        Row{"orderUpdateError", {{"topic", "order"}}, true},
        Row{"orderUpdateError", {}, true},
        Row{"actionError", {{"topic", "order"}, {"orderId", "order-1"}, {"actionId", "a1"}}, false},
        Row{"badAction", {{"topic", "order"}, {"orderId", "order-1"}, {"actionId", "a2"}}, true},
        Row{"badAction", {{"orderId", "order-1"}, {"orderUpdateId", "1"}, {"actionId", "a1"}}, true},
        Row{"badAction", {{"topic", "order"}, {"headerId", "1"}, {"orderId", "order-1"}, {"actionId", "a1"}}, true});
    CAPTURE(row.type, row.references.size());
    MasterSessionFixture bench;
    OrderBuilder builder = Run(bench);
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    bench.state.actionStates = {ActionState{"a1", "pick", {}, EActionStatus::Failed, {}}};
    bench.Refuse(row.type, row.references);
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == (row.bRejection ? 1 : 0));
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
}

TEST_CASE("4.2 An error of before an update does not reject it after a resend, but again once it has ended meanwhile")
{
    MasterSessionFixture bench;
    OrderBuilder builder = Run(bench);
    const std::vector<ErrorReference> references = GENERATE(
        std::vector<ErrorReference>{{"orderId", "order-1"}},
        std::vector<ErrorReference>{{"topic", "order"}, {"orderId", "order-1"}},
        std::vector<ErrorReference>{});
    bench.Refuse(ErrorTypes::ORDER_UPDATE_ERROR, references);
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    REQUIRE(bench.GetSent(ETopic::Order).size() == 2);
    bench.SendState();
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
    if (GENERATE(true, false))
    {
        const std::vector<VehicleError> errors = std::exchange(bench.state.errors, {});
        bench.SendState();
        CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
        bench.state.errors = errors;
        bench.SendState();
        CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE(
    "4.2 An error that names the message itself and stays is an answer to its resend, for example after a restart")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.Refuse(ErrorTypes::ORDER_ERROR, {{"orderId", "order-1"}, {"orderUpdateId", "0"}});
    REQUIRE(bench.session.ResumeOrder({{MakeOrder(2, 2)}, {}}, bench.GetNow(), bench.Clear()).has_value());
    bench.SendState();
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    bench.SendState();
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
}

TEST_CASE("4.2 An error that came before a delayed message was sent does not reject it")
{
    MasterOptions options = MakeMasterOptions();
    options.factsheet.emplace().protocolLimits.timing.minOrderInterval = 5.0;
    MasterSessionFixture bench(options);
    OrderBuilder builder = Run(bench);
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.GetSent(ETopic::Order).empty());
    bench.Refuse(ErrorTypes::ORDER_UPDATE_ERROR, {});
    bench.Wait(std::chrono::seconds(5), EMasterTimer::ResendOrder);
    REQUIRE(bench.GetSent(ETopic::Order).size() == 1);
    bench.SendState();
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
}

TEST_CASE("4.2 A first order is rejected by an error of a type of the manufacturer that names the topic only")
{
    struct Row
    {
        std::vector<ErrorReference> references;
        bool bBefore;
        bool bRejection;
    };
    const Row row = GENERATE(
        Row{{{"topic", "order"}}, false, true},
        Row{{{"topic", "order"}, {"actionId", "a2"}}, false, true},
        Row{{{"topic", "order"}}, true, false},
        Row{{{"topic", "order"}, {"actionId", "a1"}}, false, false}, // of the order before, which has ended
        Row{{{"topic", "order"}, {"headerId", "77"}}, false, false},
        Row{{{"topic", "state"}}, false, false},
        Row{{}, false, false});
    CAPTURE(row.references.size(), row.bBefore);
    MasterSessionFixture bench;
    bench.state.actionStates = {ActionState{"a1", "pick", {}, EActionStatus::Failed, {}}};
    bench.BeReady();
    if (row.bBefore)
    {
        bench.Refuse("notAllowed", row.references);
    }
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    bench.Refuse("notAllowed", row.references);
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == (row.bRejection ? 1 : 0));
}

TEST_CASE("4.3 An update replaces the horizon: its nodes are reported, the dropped ones never")
{
    MasterSessionFixture bench;
    Run(bench);
    std::vector<OrderNode> nodes = MakeNodes(3);
    nodes[2].nodeID = "OTHER";
    OrderBuilder other = *OrderBuilder::Create("order-1", nodes, MakeEdges(2));
    REQUIRE(other.MakeOrder(2).has_value());
    const OrderMessage update = *other.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(update, 0);
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N1", "OTHER"});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderLost>(bench.GetOutput()).empty());
}

TEST_CASE("2 After ONLINE headerIds start again, also for a vehicle whose clock is behind")
{
    MasterSessionFixture bench;
    const bool bRepeated = GENERATE(false, true); // an ONLINE without a will before it
    bench.BeReady();
    StateMessage reborn = bench.state;
    reborn.header = Header{0, bench.GetNow().wall - std::chrono::hours(1), "2.0.0", "ACS", "LR01"};
    const std::string payload = Vda5050Codec().Encode(reborn, EVda5050Version::Version200);
    bench.Deliver(ETopic::State, payload);
    CHECK(bench.session.GetStatistics().statesIgnored == 1);
    if (!bRepeated)
    {
        bench.Connect(EConnectionState::ConnectionBroken);
    }
    bench.Connect(EConnectionState::Online);
    bench.Deliver(ETopic::State, payload);
    CHECK(bench.session.GetStatistics().statesIgnored == 1);
    CHECK(bench.session.IsReady());
}

TEST_CASE("8.6 In a mode without master control only requests are sent; waiting messages are sent when it is back")
{
    const EOperatingMode mode = GENERATE(EOperatingMode::Manual, EOperatingMode::Service, EOperatingMode::TeachIn);
    MasterSessionFixture bench;
    OrderBuilder builder = Run(bench);
    REQUIRE(SendAction(bench, "i1", "startPause").has_value());
    bench.state.operatingMode = mode;
    bench.SendState();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(SendAction(bench, "i2", "stopPause").error().code == EVda5050Error::VehicleNotReady);
    CHECK(bench.session.Cancel(bench.GetNow(), bench.Clear()).error().code == EVda5050Error::VehicleNotReady);
    CHECK(SendAction(bench, "i3", "stateRequest").has_value());
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(Pick<PublishMessage>(bench.GetOutput()).empty());
    bench.state.operatingMode = EOperatingMode::SemiAutomatic;
    bench.SendState();
    CHECK(bench.GetSentOrder().orderUpdateID == 1);
    CHECK(GetSentActionID(bench) == "i1");
}

TEST_CASE("8.6 An order that waited for an outage and for the mode is sent once")
{
    MasterSessionFixture bench;
    bench.state.orderID = "order-0";
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(3, 3), bench.GetNow(), bench.Clear()).has_value());
    bench.state.operatingMode = EOperatingMode::Manual;
    bench.SendState();
    bench.Connect(EConnectionState::ConnectionBroken);
    bench.Connect(EConnectionState::Online);
    bench.Clear();
    bench.state.operatingMode = EOperatingMode::Automatic;
    bench.SendState();
    CHECK(bench.GetSent(ETopic::Order).size() == 1);
}

TEST_CASE("8.6 An update that waited for the echo of the one before it and for the mode is sent once")
{
    MasterSessionFixture bench;
    OrderBuilder builder = Run(bench);
    const OrderMessage first = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(first, bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear()).has_value());
    bench.state.operatingMode = EOperatingMode::Service;
    bench.SendState();
    bench.Clear();
    bench.state.operatingMode = EOperatingMode::Automatic;
    bench.Hold(first, 2);
    bench.SendState();
    REQUIRE(bench.GetSent(ETopic::Order).size() == 1);
    CHECK(bench.GetSentOrder().orderUpdateID == 2);
}

TEST_CASE("3.7 Generated ids have the form that the factsheet requires, and other ids are rejected")
{
    MasterSessionFixture bench;
    FactsheetMessage factsheet;
    MaximumStringLengths& limits = factsheet.protocolLimits.maxStringLengths;
    limits.identifier = 12;
    limits.bIdentifierNumericalOnly = GENERATE(false, true);
    PublishFactsheet(bench, factsheet);
    bench.BeReady();
    REQUIRE(SendAction(bench, {}, "startPause").has_value());
    const std::string first = GetSentActionID(bench);
    CHECK(first.size() <= 12);
    CHECK((!*limits.bIdentifierNumericalOnly || first.find_first_not_of("0123456789") == std::string::npos));
    REQUIRE(SendAction(bench, {}, "stopPause").has_value());
    CHECK(GetSentActionID(bench) != first);
    CHECK(SendAction(bench, "1234567890123", "startPause").error().path == "maxStringLens.idLen");
    CHECK(SendAction(bench, "pause-1", "startPause").has_value() == !*limits.bIdentifierNumericalOnly);
}

TEST_CASE("3.7 An instant action beyond the limits of the factsheet is not sent, and resends stay within them")
{
    MasterSessionFixture bench;
    FactsheetMessage factsheet;
    factsheet.protocolLimits.maxStringLengths.message = 400;
    factsheet.protocolLimits.maxArrayLengths.actionParameters = 1;
    PublishFactsheet(bench, factsheet);
    bench.BeReady();
    Action action = MakeAction("i1", EBlockingType::None, "takePicture");
    action.actionParameters = {{"a", Core::JsonText::FromString("1")}, {"b", Core::JsonText::FromString("2")}};
    const auto send = [&]() {
        return bench.session.SendInstantAction(action, bench.GetNow(), bench.Clear());
    };
    CHECK(send().error().path == "maxArrayLens.actions.actionsParameters");
    action.actionParameters.pop_back();
    action.actionDescription = std::string(400, 'x');
    CHECK(send().error().path == "maxStringLens.msgLen");
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
    action.actionDescription.clear();
    REQUIRE(send());
    action.actionID = "i2";
    REQUIRE(send());
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    const auto sent = bench.GetSent(ETopic::InstantActions);
    REQUIRE(sent.size() == 2);
    CHECK(std::ranges::all_of(sent, [](const MqttMessage& message) { return message.payload.size() <= 400; }));
}

TEST_CASE("13 Each invalid message is counted and reported, and changes nothing")
{
    const ETopic topic = GENERATE(ETopic::State, ETopic::Connection, ETopic::Factsheet);
    const std::string header =
        R"("headerId":9,"timestamp":"2030-01-01T00:00:00Z","version":"2.0.0","manufacturer":"ACS","serialNumber":"LR01")";
    const auto with = [&header](const std::string& part, const std::string& other) {
        return "{" + std::string(header).replace(header.find(part), part.size(), other) + "}";
    };
    const std::vector<std::string> bad{
        "",
        "no JSON",
        "null",
        "[]",
        "{",
        "{" + header + "}", // nothing but the header
        with("9,", "-1,"),
        with("9,", "4294967296,"),
        with("9,", "NaN,"),
        with("9,", R"("9",)"),
        with("9,", "null,"),
        with("2.0.0", "3.0.0"),
        with(R"("ACS")", R"("OTHER")"),
        with("LR01", "LR/01"),
        std::string(1'000, '{')};
    MasterSessionFixture bench;
    Run(bench);
    const StateMessage before = *bench.session.GetStateOrNull();
    bench.Clear();
    for (const std::string& payload : bad)
    {
        CAPTURE(payload);
        bench.Deliver(topic, payload);
        CHECK(bench.GetOutput().size() == 1);
        CHECK(Pick<MessageRefused>(bench.GetOutput()).size() == 1);
        bench.Clear();
    }
    CHECK(bench.session.GetStatistics().messagesRefused == bad.size());
    CHECK(*bench.session.GetStateOrNull() == before);
    CHECK(bench.session.IsReady());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
}

TEST_CASE("3.1 The names and the version of a refused header are truncated in the reason")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const bool bVersion = GENERATE(true, false);
    const std::string text(3'000, 'x');
    StateMessage state;
    state.header = Header{99, bench.GetNow().wall, bVersion ? "3" + text : "2.0.0", "ACS", bVersion ? "LR01" : text};
    bench.Deliver(ETopic::State, Vda5050Codec().Encode(state, EVda5050Version::Version200));
    const auto refused = Pick<MessageRefused>(bench.GetOutput());
    REQUIRE(refused.size() == 1);
    CHECK(refused[0].error.found.size() <= 1024);
    CHECK(bench.session.GetStatistics().lastRefusal.size() <= 1200);
}

} // namespace ACS::VDA5050::Test

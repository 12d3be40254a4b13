#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

constexpr std::size_t MOST_INSTANT = 128;

VehicleOptions MakeSlow()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.minimumStateInterval = std::chrono::milliseconds(50);
    return options;
}

OrderMessage WithActions(OrderMessage order, std::size_t node, std::size_t count, const std::string& prefix)
{
    for (std::size_t index = 0; index < count; ++index)
    {
        order.nodes.at(node).actions.push_back(MakeAction(prefix + std::to_string(index), EBlockingType::None, "beep"));
    }
    return order;
}

/// The last published state has an orderError with this rule.
void CheckRefused(const VehicleSessionFixture& bench, std::string_view rule)
{
    REQUIRE_FALSE(bench.GetPublishedStates().empty());
    const StateMessage state = bench.GetPublishedStates().back();
    REQUIRE_FALSE(state.errors.empty());
    CHECK(state.errors[0].errorType == ErrorTypes::ORDER_ERROR);
    CHECK(state.errors[0].errorDescription.find(rule) != std::string::npos);
}

std::set<std::string> ListShown(const VehicleSessionFixture& bench)
{
    std::set<std::string> ids;
    for (const StateMessage& state : bench.GetPublishedStates())
    {
        for (const ActionState& action : state.actionStates)
        {
            ids.insert(action.actionID);
        }
    }
    return ids;
}

} // namespace

TEST_CASE("6.10 An order with more actions than a state can show is rejected, also when an update adds them")
{
    constexpr std::size_t HALF = 5'000;
    VehicleSessionFixture bench;
    OrderMessage order = WithActions(MakeOrder(2, 2), 0, HALF, "a");
    bench.Order(WithActions(order, 1, HALF, "b"));
    CheckRefused(bench, "actionStates is 9840, found 10000");
    CHECK_FALSE(bench.GetSession().IsOrderRunning());

    VehicleSessionFixture updated;
    OrderBuilder builder = MakeBuilder(3);
    updated.Order(WithActions(*builder.MakeOrder(2, 0), 0, HALF, "a"));
    updated.Clear();
    updated.Order(WithActions(*builder.MakeUpdate(3), 1, HALF, "b"));
    CheckRefused(updated, "actionStates");
    CHECK(updated.GetPublishedState().orderUpdateID == 0);
    CHECK(updated.GetPublishedState().actionStates.size() == HALF);
}

TEST_CASE("6.10 An order whose state would exceed the length of a message is rejected, also by the sum of its updates")
{
    constexpr std::size_t LENGTH = 60'000;
    constexpr std::size_t NODES = 40;
    const std::string text(LENGTH, 'x');
    const std::vector<std::function<void(OrderMessage&, std::size_t)>> fillers{
        [&text](OrderMessage& order, std::size_t index) { order.nodes[index].nodeDescription = text; },
        [&text](OrderMessage& order, std::size_t index) { order.edges[index - 1].edgeDescription = text; },
        [&text](OrderMessage& order, std::size_t index) {
            Action action = MakeAction("a" + std::to_string(index), EBlockingType::None, "beep");
            action.actionDescription = text;
            order.nodes[index].actions.push_back(std::move(action));
        },
        [](OrderMessage& order, std::size_t index) {
            // Written with 6 bytes each.
            order.nodes[index].nodeDescription = std::string(LENGTH / 6, '\x01');
        },
    };
    for (std::size_t filler = 0; filler < fillers.size(); ++filler)
    {
        CAPTURE(filler);
        OrderMessage order = MakeOrder(NODES, NODES);
        for (std::size_t index = 1; index < NODES; ++index)
        {
            fillers[filler](order, index);
        }
        VehicleSessionFixture bench;
        bench.Order(order);
        CheckRefused(bench, "maximum length of the state");

        VehicleSessionFixture updated;
        OrderBuilder builder = MakeBuilder(NODES);
        OrderMessage first = *builder.MakeOrder(NODES / 2, 0);
        OrderMessage second = *builder.MakeUpdate(NODES);
        for (OrderMessage* part : {&first, &second})
        {
            for (std::size_t index = 1; index < part->nodes.size(); ++index)
            {
                fillers[filler](*part, index);
            }
        }
        for (std::size_t index = 1; index < second.nodes.size(); ++index)
        {
            for (Action& action : second.nodes[index].actions)
            {
                action.actionID += "-second";
            }
        }
        updated.Order(first);
        CHECK(updated.GetSession().IsOrderRunning());
        updated.Clear();
        updated.Order(second);
        CheckRefused(updated, "maximum length of the state");
    }
}

TEST_CASE("6.10 Long texts of a vehicle are left out before a state becomes too long to be decoded")
{
    constexpr std::size_t LENGTH = 60'000;
    VehicleSessionFixture bench;
    Information information;
    information.infoDescription = std::string(LENGTH, 'x');
    bench.GetSession().OnInformation(std::vector(100, information));
    bench.Instant("stateRequest", "i1");
    REQUIRE(bench.GetPublishedStates().size() == 1);
    CHECK(bench.GetPublishedState().information.empty());
    bench.Clear();
    bench.GetSession().OnInformation(std::vector(10, information));
    bench.Instant("stateRequest", "i2");
    CHECK(bench.GetPublishedState().information.size() == 10);
    bench.GetSession().OnInformation(std::vector(10'001, Information{}));
    bench.Instant("stateRequest", "i3");
    CHECK(bench.GetPublishedState().information.size() == 10'000);
}

TEST_CASE("5.5 A result is never longer than an error may repeat, whatever its source")
{
    VehicleSessionFixture bench;
    bench.Order(WithActions(MakeOrder(2, 2), 0, 1, "a"));
    VehicleActions out;
    CHECK(bench.GetSession()
              .TrySetActionStatus("a0", EActionStatus::Failed, std::string(70'000, 'x'), bench.GetNow(), out));
    CHECK(bench.GetSession().GetState().actionStates.at(0).resultDescription.size() == 1024);
}

TEST_CASE("5.5 An instant action is kept until a state has shown its end; further ones are reported as errors")
{
    constexpr std::size_t SENT = 1'000;
    VehicleSessionFixture bench(MakeSlow());
    bench.Instant("stateRequest", "first");
    bench.Clear();
    for (std::size_t index = 0; index < SENT; ++index)
    {
        bench.Instant("stateRequest", "i" + std::to_string(index));
    }
    bench.Advance(std::chrono::milliseconds(50));
    bench.Clear();
    VehicleActions out;
    bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
    const StateMessage state = bench.GetSession().GetState();
    CHECK(state.actionStates.size() == MOST_INSTANT);
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
    CHECK(bench.GetStatus("i0") == EActionStatus::Finished);
    // Shown now: they make way, the oldest first.
    bench.Instant("stateRequest", "last");
    CHECK(bench.GetStatus("last") == EActionStatus::Finished);
    CHECK(bench.GetSession().GetState().actionStates.size() == MOST_INSTANT);
    CHECK(ListShown(bench).empty());
}

TEST_CASE("5.6 An instant action that was shown and removed is not performed again, and its id stays in use")
{
    VehicleSessionFixture bench;
    bench.Instant("startPause", "pause");
    bench.Instant("stopPause", "go");
    for (std::size_t index = 0; index < MOST_INSTANT; ++index)
    {
        bench.Instant("stateRequest", "i" + std::to_string(index));
    }
    const StateMessage state = bench.GetSession().GetState();
    CHECK(std::ranges::find(state.actionStates, "pause", &ActionState::actionID) == state.actionStates.end());
    bench.Instant("startPause", "pause");
    CHECK_FALSE(bench.GetSession().IsPaused());
    CHECK(bench.GetSession().GetState().errors.empty());
    bench.Instant("stateRequest", "pause");
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
    // A new order ends the report, and with it the ids of it.
    bench.Order(MakeOrder(2, 2));
    bench.Instant("startPause", "pause");
    CHECK(bench.GetSession().IsPaused());
}

TEST_CASE("5.5 Instant actions share a part of the state; a vehicle can be stopped when that is full")
{
    VehicleSessionFixture bench(MakeSlow());
    bench.Instant("stateRequest", "first");
    const std::string text(1'000, '\x01');
    for (std::size_t index = 0; index < MOST_INSTANT; ++index)
    {
        Action action = MakeAction("i" + std::to_string(index), EBlockingType::None, "stateRequest");
        action.actionDescription = text + text;
        bench.Instant({action});
    }
    const std::size_t shown = bench.GetSession().GetState().actionStates.size();
    CHECK(shown > MOST_INSTANT / 2);
    CHECK(shown < MOST_INSTANT);
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
    bench.Instant("startPause", "pause");
    CHECK(bench.GetSession().IsPaused());
    bench.Instant("stopPause", "go");
    CHECK_FALSE(bench.GetSession().IsPaused());
}

TEST_CASE("5.5 Repeated cancels of a vehicle that is on its way are shown up to a bound")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.bStopsBetweenNodes = false;
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(3, 3));
    bench.Drive(true);
    for (int i = 0; i < 300; ++i)
    {
        bench.Instant("cancelOrder", "c" + std::to_string(i));
        bench.Clear();
    }
    CHECK(bench.GetSession().GetState().actionStates.size() == MOST_INSTANT + 32);
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
}

TEST_CASE("5.6 Names of an action that states would repeat are bounded")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    VehicleSessionFixture bench(options);
    bench.Instant(
        "downloadMap",
        "m1",
        {{"mapId", Core::JsonText::FromString(std::string(2'000, 'x'))},
         {"mapVersion", Core::JsonText::FromString("1")},
         {"mapDownloadLink", Core::JsonText::FromString("https://maps")}});
    CHECK(bench.GetStatus("m1") == EActionStatus::Failed);
    CHECK(bench.GetPublishedState().errors.at(0).errorDescription.find("too long") == 0);
}

TEST_CASE("4.2 The error about a message names what could be decoded of it, whatever else is wrong")
{
    struct Case
    {
        const char* payload;
        const char* headerID;
        const char* orderID;
        const char* orderUpdateID;
    };
    const std::vector<Case> cases{
        {R"({"headerId":7,"orderId":"A","orderUpdateId":-1})", "7", "A", nullptr},
        {R"({"headerId":"x","orderId":"A","orderUpdateId":3})", nullptr, "A", "3"},
        {R"({"orderId":5,"orderUpdateId":3})", nullptr, nullptr, "3"},
        {R"({"headerId":1,"manufacturer":[]})", "1", nullptr, nullptr},
        {"{", nullptr, nullptr, nullptr},
    };
    for (const Case& row : cases)
    {
        CAPTURE(row.payload);
        VehicleSessionFixture bench;
        bench.Payload(ETopic::Order, row.payload);
        const VehicleError error = bench.GetPublishedState().errors.at(0);
        const auto check = [&error](std::string_view key, const char* expectedOrNull) {
            CAPTURE(key);
            const std::string* const found = FindReferenceOrNull(error, key);
            REQUIRE((found == nullptr) == (expectedOrNull == nullptr));
            CHECK((found == nullptr || *found == expectedOrNull));
        };
        check("headerId", row.headerID);
        check("orderId", row.orderID);
        check("orderUpdateId", row.orderUpdateID);
    }
}

TEST_CASE("8.4 An error is reported until its cause ends, whatever its text is")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.orderCheck = [](const OrderMessage& order, const OrderContext& /*context*/) {
        return std::vector{MakeOrderViolation(order, ErrorTypes::ORDER_ERROR, "the operating mode takes no orders")};
    };
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(2, 2));
    bench.Mode(EOperatingMode::Service);
    bench.Mode(EOperatingMode::Automatic);
    CHECK(bench.HasError(ErrorTypes::ORDER_ERROR));
}

TEST_CASE("4.2 A message can be handled as the link delivers it")
{
    VehicleSessionFixture bench;
    VehicleActions out;
    MqttMessage message{BuildTopic(MakeAddress(), ETopic::Order), "{", 0, true};
    bench.GetSession().OnMessage(message, bench.GetNow(), out);
    CHECK(bench.GetSession().GetState().errors.empty()); // retained
    message.bRetained = false;
    bench.GetSession().OnMessage(message, bench.GetNow(), out);
    CHECK(bench.GetSession().GetState().errors.size() == 1);
}

} // namespace ACS::VDA5050::Test

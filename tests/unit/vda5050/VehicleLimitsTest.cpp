#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace ACS::VDA5050::Test
{

namespace
{

constexpr double INVALID_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double ENDLESS = std::numeric_limits<double>::infinity();

VehicleOptions MakeLimited(const std::function<void(ProtocolLimits&)>& limit)
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    limit(options.factsheet.protocolLimits);
    return options;
}

VehicleError MakeError(const std::string& errorType, EErrorLevel level)
{
    VehicleError error;
    error.errorType = errorType;
    error.errorLevel = level;
    return error;
}

std::vector<std::string> ListErrors(const StateMessage& state)
{
    std::vector<std::string> types;
    std::ranges::transform(state.errors, std::back_inserter(types), &VehicleError::errorType);
    return types;
}

std::vector<std::string> ListActions(const StateMessage& state)
{
    std::vector<std::string> ids;
    std::ranges::transform(state.actionStates, std::back_inserter(ids), &ActionState::actionID);
    return ids;
}

OrderMessage WithActions(OrderMessage order, std::size_t count)
{
    for (std::size_t index = 0; index < count; ++index)
    {
        order.nodes.back().actions.push_back(
            MakeAction(order.orderID + std::to_string(index), EBlockingType::None, "stopCharging"));
    }
    return order;
}

} // namespace

TEST_CASE("3.7 An instant action that exceeds the factsheet fails alone, with the reason")
{
    struct Case
    {
        const char* name;
        std::function<void(ProtocolLimits&)> limit;
        Action action;
        std::string_view member;
    };
    Action withParameters = MakeAction("1", EBlockingType::None, "logReport");
    withParameters.actionParameters = {{"reason", Core::JsonText::FromString("a")}};
    const std::vector<Case> cases{
        {"the id is too long",
         [](ProtocolLimits& limits) { limits.maxStringLengths.identifier = 3; },
         MakeAction("1234", EBlockingType::None, "stateRequest"),
         "maxStringLens.idLen"},
        {"the id is no number",
         [](ProtocolLimits& limits) { limits.maxStringLengths.bIdentifierNumericalOnly = true; },
         MakeAction("s1", EBlockingType::None, "stateRequest"),
         "maxStringLens.idNumericalOnly"},
        {"too many parameters",
         [](ProtocolLimits& limits) { limits.maxArrayLengths.actionParameters = 1; },
         [&withParameters] {
             Action action = withParameters;
             action.actionParameters.push_back({"more", Core::JsonText::FromString("b")});
             return action;
         }(),
         "maxArrayLens.actions.actionsParameters"},
    };
    for (const Case& size : cases)
    {
        CAPTURE(size.name);
        VehicleSessionFixture bench(MakeLimited(size.limit));
        bench.Instant({size.action, withParameters});
        CHECK(bench.GetStatus(size.action.actionID) == EActionStatus::Failed);
        CHECK(bench.GetStartedActions().size() == (size.action.actionID == "1" ? 0 : 1));
        const StateMessage state = bench.GetPublishedState();
        REQUIRE(state.errors.size() == 1);
        CHECK(state.errors[0].errorType == ErrorTypes::INSTANT_ACTION_ERROR);
        CHECK(*FindReferenceOrNull(state.errors[0], "actionId") == size.action.actionID);
        CHECK(*FindReferenceOrNull(state.errors[0], "parameter") == size.member);
    }
}

TEST_CASE("3.7 Instant actions in a message that is too long are a validationError")
{
    VehicleSessionFixture bench(MakeLimited([](ProtocolLimits& limits) { limits.maxStringLengths.message = 300; }));
    bench.Instant("stateRequest", "i1");
    CHECK(bench.GetStatus("i1") == EActionStatus::Finished);
    bench.Instant("stateRequest", std::string(300, 'x'));
    CHECK(bench.HasError(ErrorTypes::VALIDATION_ERROR));
    CHECK(bench.GetSession().GetState().actionStates.size() == 1);
}

TEST_CASE("3.7 An order whose state would exceed the factsheet is rejected with orderError")
{
    struct Case
    {
        const char* name;
        std::function<void(ProtocolLimits&)> limit;
        const char* parameter;
    };
    const std::vector<Case> cases{
        {"nodeStates",
         [](ProtocolLimits& limits) { limits.maxArrayLengths.stateNodeStates = 3; },
         "maxArrayLens.state.nodeStates"},
        {"edgeStates",
         [](ProtocolLimits& limits) { limits.maxArrayLengths.stateEdgeStates = 3; },
         "maxArrayLens.state.edgeStates"},
        {"actionStates",
         [](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 3; },
         "maxArrayLens.state.actionStates"},
    };
    for (const Case& size : cases)
    {
        CAPTURE(size.name);
        const auto check = [&size](VehicleSessionFixture& bench, bool bTaken) {
            CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) != bTaken);
            if (!bTaken)
            {
                CHECK(*FindReferenceOrNull(bench.GetPublishedState().errors.at(0), "parameter") == size.parameter);
            }
        };
        VehicleSessionFixture fresh(MakeLimited(size.limit));
        fresh.Order(WithActions(MakeOrder(5, 5), 4));
        check(fresh, false);
        fresh.Order(WithActions(MakeOrder(4, 4), 3));
        check(fresh, true);
        // What an update adds is counted to what is left of the base, its horizon is not.
        VehicleSessionFixture updated(MakeLimited(size.limit));
        OrderBuilder builder = MakeBuilder(6);
        OrderMessage first = *builder.MakeOrder(2, 2);
        first.nodes[1].actions.push_back(MakeAction("kept", EBlockingType::None, "stopCharging"));
        first.nodes[3].actions.push_back(MakeAction("dropped", EBlockingType::None, "stopCharging"));
        updated.Order(first);
        check(updated, true);
        OrderBuilder longer = builder;
        updated.Order(WithActions(*longer.MakeUpdate(5, 0), 3));
        check(updated, false);
        updated.Order(WithActions(*builder.MakeUpdate(4, 0), 2));
        check(updated, true);
        CHECK(updated.GetSession().GetState().orderUpdateID == 1);
    }
}

TEST_CASE("3.7 What counts for the limit of actionStates: the first node's actions, and instant ones that run")
{
    for (const bool bRuns : {false, true})
    {
        CAPTURE(bRuns);
        VehicleSessionFixture bench(
            MakeLimited([](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 4; }));
        bench.Instant("startCharging", "i1");
        bench.Status("i1", EActionStatus::Running);
        if (!bRuns)
        {
            bench.Status("i1", EActionStatus::Finished);
        }
        bench.Order(WithActions(MakeOrder(1, 1), 4));
        CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) == bRuns);

        VehicleSessionFixture updated(
            MakeLimited([](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 4; }));
        OrderBuilder builder = MakeBuilder(3);
        updated.Order(*builder.MakeOrder(2, 0));
        updated.Instant("startCharging", "i1");
        updated.Status("i1", EActionStatus::Running);
        if (!bRuns)
        {
            updated.Status("i1", EActionStatus::Finished);
        }
        updated.Order(WithActions(*builder.MakeUpdate(3), 4));
        CHECK(updated.HasError(ErrorTypes::ORDER_ERROR) == bRuns);
    }
    VehicleSessionFixture first(
        MakeLimited([](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 4; }));
    first.Order(WithActions(MakeOrder(1, 1), 5));
    CHECK(first.HasError(ErrorTypes::ORDER_ERROR));
}

TEST_CASE("3.7 Where actionStates is limited instant actions that have ended make way; a vehicle can always be stopped")
{
    VehicleSessionFixture bench(
        MakeLimited([](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 3; }));
    for (const char* actionID : {"i1", "i2", "i3", "i4"})
    {
        bench.Instant("stateRequest", actionID);
    }
    using ActionIDs = std::vector<std::string>;
    CHECK(ListActions(bench.GetPublishedState()) == ActionIDs{"i2", "i3", "i4"});
    OrderBuilder builder = MakeBuilder(3);
    bench.Order(WithActions(*builder.MakeOrder(2, 0), 2));
    bench.Instant("stateRequest", "i5");
    bench.Order(*builder.MakeUpdate(3));
    CHECK(ListActions(bench.GetPublishedState()) == ActionIDs{"order-10", "order-11", "i5"});
    bench.Instant("startCharging", "i6");
    CHECK(ListActions(bench.GetPublishedState()) == ActionIDs{"order-10", "order-11", "i6"});
    // i6 runs: there is no room for another one.
    bench.Instant("startCharging", "i7");
    CHECK(ListActions(bench.GetPublishedState()) == ActionIDs{"order-10", "order-11", "i6"});
    CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
    CHECK(bench.GetStartedActions() == ActionIDs{"i6"});
    for (const char* actionType : {"startPause", "stopPause", "cancelOrder"})
    {
        bench.Instant(actionType, actionType);
        CHECK(bench.GetStatus(actionType) != EActionStatus::Failed);
    }
}

TEST_CASE("3.7 An update makes room for its actions among the instant actions that have ended")
{
    VehicleSessionFixture bench(
        MakeLimited([](ProtocolLimits& limits) { limits.maxArrayLengths.stateActionStates = 3; }));
    OrderBuilder builder = MakeBuilder(3);
    bench.Order(*builder.MakeOrder(2, 0));
    for (const char* actionID : {"i1", "i2", "i3"})
    {
        bench.Instant("stateRequest", actionID);
    }
    bench.Order(WithActions(*builder.MakeUpdate(3), 2));
    CHECK(ListActions(bench.GetPublishedState()) == std::vector<std::string>{"i3", "order-10", "order-11"});
}

TEST_CASE("3.7 A state keeps the limits of the factsheet: loads, errors, information and references")
{
    VehicleSessionFixture bench(MakeLimited([](ProtocolLimits& limits) {
        limits.maxArrayLengths.stateLoads = 1;
        limits.maxArrayLengths.stateErrors = 2;
        limits.maxArrayLengths.stateInformation = 1;
        limits.maxArrayLengths.errorReferences = 3;
        limits.maxArrayLengths.informationReferences = 1;
    }));
    VehicleActions out;
    Load load;
    load.loadID = "L1";
    bench.GetSession().OnLoads(std::vector{load, Load{}}, bench.GetNow(), out);
    Information information;
    information.infoReferences = {{"a", "1"}, {"b", "2"}};
    bench.GetSession().OnInformation({information, Information{}});
    bench.GetSession().OnErrors(
        {MakeError("first", EErrorLevel::Warning),
         MakeError("grave", EErrorLevel::Fatal),
         MakeError("second", EErrorLevel::Warning)},
        bench.GetNow(),
        out);
    bench.Payload(ETopic::Order, "{");
    StateMessage state = bench.GetPublishedState();
    CHECK(state.loads == std::vector{load});
    REQUIRE(state.information.size() == 1);
    CHECK(state.information[0].infoReferences.size() == 1);
    // The fatal one stays, and the latest.
    CHECK(ListErrors(state) == std::vector<std::string>{"grave", "validationError"});
    bench.StandAt(5.0);
    bench.Order(MakeOrder(2, 2));
    state = bench.GetPublishedState();
    CHECK(ListErrors(state) == std::vector<std::string>{"grave", "noRouteError"});
    CHECK(state.errors.back().errorReferences.size() == 3);
    bench.GetSession().OnErrors(
        {MakeError("grave1", EErrorLevel::Fatal),
         MakeError("grave2", EErrorLevel::Fatal),
         MakeError("grave3", EErrorLevel::Fatal)},
        bench.GetNow(),
        out);
    CHECK(ListErrors(bench.GetSession().GetState()) == std::vector<std::string>{"grave2", "grave3"});
    CheckPublished(out);
}

TEST_CASE("2 A value that is not a number is never published: optional members are left out, position and charge stay")
{
    for (const double bad : {INVALID_NUMBER, ENDLESS, -ENDLESS})
    {
        CAPTURE(bad);
        VehicleSessionFixture bench;
        bench.StandAt(3.0);
        VehicleActions out;
        BatteryState battery;
        battery.batteryCharge = 55.0;
        bench.GetSession().OnBattery(battery, bench.GetNow(), out);
        AgvPosition position;
        position.bPositionInitialized = true;
        position.mapID = "floor";
        for (double AgvPosition::*const member : {&AgvPosition::x, &AgvPosition::y, &AgvPosition::theta})
        {
            AgvPosition wrong = position;
            wrong.*member = bad;
            bench.GetSession().OnPosition(wrong, Velocity{1.0, {}, {}});
            CHECK(bench.GetSession().GetState().agvPosition->x == 3.0);
            CHECK_FALSE(bench.GetSession().GetState().velocity->vx.has_value());
        }
        position.x = 4.0;
        position.localizationScore = bad;
        position.deviationRange = bad;
        bench.GetSession().OnPosition(position, Velocity{bad, bad, bad}, bad);
        bench.GetSession().OnBattery(BatteryState{bad, bad, bad, true, bad}, bench.GetNow(), out);
        Load load;
        load.loadID = "L1";
        load.weight = bad;
        std::vector<Load> loads(6, load);
        loads[0].boundingBoxReference = BoundingBoxReference{bad, 0.0, 0.0, {}};
        loads[1].boundingBoxReference = BoundingBoxReference{0.0, bad, 0.0, {}};
        loads[2].boundingBoxReference = BoundingBoxReference{0.0, 0.0, bad, {}};
        loads[3].loadDimensions = LoadDimensions{bad, 1.0, {}};
        loads[4].loadDimensions = LoadDimensions{1.0, bad, {}};
        loads[5].boundingBoxReference = BoundingBoxReference{1.0, 2.0, 3.0, bad};
        loads[5].loadDimensions = LoadDimensions{1.0, 2.0, bad};
        bench.GetSession().OnLoads(loads, bench.GetNow(), out);
        CheckPublished(out);
        out.clear();
        bench.GetSession().OnLoads(loads, bench.GetNow(), out);
        CHECK(out.empty()); // nothing has changed
        const StateMessage state = bench.GetSession().GetState();
        CHECK(state.agvPosition->x == 4.0);
        CHECK_FALSE(state.agvPosition->localizationScore.has_value());
        CHECK_FALSE(state.agvPosition->deviationRange.has_value());
        CHECK(state.velocity == Velocity{});
        CHECK_FALSE(state.distanceSinceLastNode.has_value());
        BatteryState expected;
        expected.batteryCharge = 55.0;
        expected.bCharging = true;
        CHECK(state.batteryState == expected);
        Load plain;
        plain.loadID = "L1";
        std::vector<Load> expectedLoads(6, plain);
        expectedLoads[5].boundingBoxReference = BoundingBoxReference{1.0, 2.0, 3.0, {}};
        expectedLoads[5].loadDimensions = LoadDimensions{1.0, 2.0, {}};
        CHECK(state.loads == expectedLoads);
    }
}

TEST_CASE("7 A heading beyond a half turn is published within pi")
{
    VehicleSessionFixture bench;
    bench.StandAt(1.0, 4.0);
    CHECK(bench.GetSession().GetState().agvPosition->theta == Approx(4.0 - 2.0 * std::acos(-1.0)));
    bench.StandAt(1.0, -3.0);
    CHECK(bench.GetSession().GetState().agvPosition->theta == -3.0);
}

TEST_CASE("8.2 batteryHealth is published as it was measured, and whole in 2.0 alone")
{
    for (const EVda5050Version version : {EVda5050Version::Version200, EVda5050Version::Version210})
    {
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        options.version = version;
        VehicleSessionFixture bench(options);
        BatteryState battery;
        battery.batteryHealth = 87.6;
        battery.bCharging = true;
        VehicleActions out;
        bench.GetSession().OnBattery(battery, bench.GetNow(), out);
        const Core::Result<StateMessage> sent =
            Vda5050Codec().Decode<StateMessage>(Pick<PublishMessage>(out).at(0).message.payload);
        CHECK(sent->batteryState.batteryHealth == (version == EVda5050Version::Version200 ? 88.0 : 87.6));
    }
}

TEST_CASE("8.4 Every error refers to a topic: some masters take one without for the rejection of the last order")
{
    VehicleSessionFixture bench;
    VehicleActions out;
    VehicleError own = MakeError("own", EErrorLevel::Warning);
    own.errorReferences = {{"topic", "factsheet"}};
    bench.GetSession().OnErrors({MakeError("obstacle", EErrorLevel::Warning), own}, bench.GetNow(), out);
    bench.GetSession().OnErrors({MakeError("obstacle", EErrorLevel::Warning), own}, bench.GetNow(), out);
    CHECK(Pick<PublishMessage>(out).size() == 1);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions.push_back(MakeAction("fails", EBlockingType::Hard));
    bench.Order(order);
    bench.Status("fails", EActionStatus::Failed);
    const StateMessage state = bench.GetPublishedState();
    CHECK(ListErrors(state) == std::vector<std::string>{"obstacle", "own", "actionError"});
    const std::vector<std::string> topics{"state", "factsheet", "order"};
    for (std::size_t index = 0; index < topics.size(); ++index)
    {
        CHECK(*FindReferenceOrNull(state.errors.at(index), "topic") == topics[index]);
        CHECK(state.errors.at(index).errorReferences.size() == (topics[index] == "order" ? 3 : 1));
    }
}

TEST_CASE("4.2 Texts of a peer are truncated in errors: the state stays short")
{
    constexpr std::size_t LENGTH = 60'000;
    constexpr std::size_t ENOUGH = 20'000;
    const std::string text = "x" + [] {
        std::string twoBytes;
        for (std::size_t index = 0; index < LENGTH / 2; ++index)
        {
            twoBytes += "\u00e4";
        }
        return twoBytes;
    }();
    const std::vector<std::function<void(VehicleSessionFixture&)>> attacks{
        [&text](VehicleSessionFixture& bench) { bench.Instant(text, "i1"); },
        [&text](VehicleSessionFixture& bench) { bench.Instant("stateRequest", text); },
        [&text](VehicleSessionFixture& bench) {
            bench.Instant("logReport", "i1", {{text, Core::JsonText::FromString("")}});
        },
        [&text](VehicleSessionFixture& bench) { bench.Order(MakeOrder(2, 2, text)); },
        [&text](VehicleSessionFixture& bench) {
            OrderMessage order = MakeOrder(2, 2);
            order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::None, text));
            bench.Order(order);
        },
        [&text](VehicleSessionFixture& bench) {
            OrderMessage order = MakeOrder(2, 2);
            order.nodes[1].nodePosition->mapID = text;
            bench.Order(order);
        },
        [&text](VehicleSessionFixture& bench) {
            OrderMessage order = MakeOrder(2, 2);
            order.zoneSetID = text;
            bench.Order(order);
        },
    };
    for (std::size_t index = 0; index < attacks.size(); ++index)
    {
        CAPTURE(index);
        VehicleOptions options = MakeLimited([](ProtocolLimits&) {});
        VehicleSessionFixture bench(options);
        attacks[index](bench);
        const std::vector<PublishMessage> sent = Pick<PublishMessage>(bench.GetOutput());
        REQUIRE(sent.size() == 1);
        CHECK(sent[0].message.payload.size() < ENOUGH);
        CHECK(Vda5050Codec().Decode<StateMessage>(sent[0].message.payload).has_value());
        CHECK_FALSE(bench.GetPublishedState().errors.empty());
        CHECK(bench.GetPublishedState().orderID.empty());
    }
}

TEST_CASE("4.1 Only the first few of a thousand broken rules of an order are reported")
{
    OrderMessage order = MakeOrder(500, 500);
    for (OrderNode& node : order.nodes)
    {
        node.nodePosition->theta = 9.0;
        node.sequenceID += 1;
    }
    CHECK(ValidateOrder(order).size() == 16);
    VehicleSessionFixture bench;
    OrderMessage first = WithActions(MakeOrder(2, 1), 0);
    for (int i = 0; i < 40; ++i)
    {
        first.nodes[0].actions.push_back(MakeAction("a" + std::to_string(i), EBlockingType::None, "pick"));
    }
    bench.Order(first);
    OrderMessage update = MakeOrder(2, 1);
    update.orderUpdateID = 1;
    update.nodes[1].actions = first.nodes[0].actions;
    bench.Order(update);
    CHECK(bench.GetSession().GetState().errors.size() == 16);
}

TEST_CASE("4.2 The error about an undecodable order names what could be decoded, and nothing else")
{
    struct Case
    {
        const char* rest;
        const char* orderID;
        const char* orderUpdateID;
    };
    const std::vector<Case> cases{
        {R"("orderId":"A")", "A", nullptr},
        {R"("orderId":"A","orderUpdateId":3)", "A", "3"},
        {R"("orderUpdateId":3)", nullptr, "3"},
    };
    for (const Case& payload : cases)
    {
        CAPTURE(payload.rest);
        VehicleSessionFixture bench;
        bench.Payload(
            ETopic::Order,
            R"({"headerId":7,"timestamp":"2025-01-01T00:00:00Z","version":"2.0.0","manufacturer":"ACS","serialNumber":"LR01",)"
                + std::string(payload.rest) + "}");
        const VehicleError error = bench.GetPublishedState().errors.at(0);
        const std::string* orderID = FindReferenceOrNull(error, "orderId");
        const std::string* updateID = FindReferenceOrNull(error, "orderUpdateId");
        CHECK((orderID == nullptr) == (payload.orderID == nullptr));
        CHECK((updateID == nullptr) == (payload.orderUpdateID == nullptr));
        CHECK((orderID == nullptr || *orderID == payload.orderID));
        CHECK((updateID == nullptr || *updateID == payload.orderUpdateID));
    }
}

} // namespace ACS::VDA5050::Test

#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <functional>

namespace ACS::VDA5050::Test
{

namespace
{

constexpr std::chrono::milliseconds MINIMUM{50};

VehicleOptions MakeSlowStates()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.minimumStateInterval = MINIMUM;
    return options;
}

VehicleError MakeOwnError()
{
    VehicleError error;
    error.errorType = "obstacle";
    return error;
}

} // namespace

TEST_CASE("4.6 Each reason to send a state sends one, and nothing else does")
{
    struct Case
    {
        const char* name;
        std::function<void(VehicleSessionFixture&, VehicleActions&)> change;
        bool bSends;
    };
    const std::vector<Case> cases{
        {"order", [](VehicleSessionFixture& bench, VehicleActions&) { bench.Order(MakeOrder(2, 2, "order-2")); }, true},
        {"order update",
         [](VehicleSessionFixture& bench, VehicleActions&) {
             OrderBuilder builder = MakeBuilder(3);
             REQUIRE(builder.MakeOrder(2).has_value());
             bench.Order(*builder.MakeUpdate(3));
         },
         true},
        {"the same order again",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Order(MakeOrder(3, 2)); },
         true},
        {"an undecodable order",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Payload(ETopic::Order, "{"); },
         true},
        {"undecodable instant actions",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Payload(ETopic::InstantActions, "{"); },
         true},
        {"stateRequest",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Instant("stateRequest", "i1"); },
         true},
        {"node passed", [](VehicleSessionFixture& bench, VehicleActions&) { bench.Reach(2); }, true},
        {"driving", [](VehicleSessionFixture& bench, VehicleActions&) { bench.Drive(true); }, true},
        {"driving as before", [](VehicleSessionFixture& bench, VehicleActions&) { bench.Drive(false); }, false},
        {"paused", [](VehicleSessionFixture& bench, VehicleActions&) { bench.HardwarePause(true, false); }, true},
        {"action status",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Status("a1", EActionStatus::Running); },
         true},
        {"operating mode",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Mode(EOperatingMode::SemiAutomatic); },
         true},
        {"operating mode as before",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.Mode(EOperatingMode::Automatic); },
         false},
        {"errors",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnErrors({MakeOwnError()}, bench.GetNow(), out);
         },
         true},
        {"loads",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnLoads(std::vector{Load{}}, bench.GetNow(), out);
         },
         true},
        {"loads as before",
         [](VehicleSessionFixture& bench, VehicleActions& out) { bench.GetSession().OnLoads({}, bench.GetNow(), out); },
         false},
        {"maps",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnMaps(std::vector<MapState>(), bench.GetNow(), out);
         },
         true},
        {"safety",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnSafetyState(SafetyState{EEmergencyStop::Manual, false}, bench.GetNow(), out);
         },
         true},
        {"charging",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             BatteryState battery;
             battery.bCharging = true;
             bench.GetSession().OnBattery(battery, bench.GetNow(), out);
         },
         true},
        {"battery level",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             BatteryState battery;
             battery.batteryCharge = 12.0;
             bench.GetSession().OnBattery(battery, bench.GetNow(), out);
         },
         false},
        {"position", [](VehicleSessionFixture& bench, VehicleActions&) { bench.StandAt(0.1); }, false},
        {"information",
         [](VehicleSessionFixture& bench, VehicleActions&) { bench.GetSession().OnInformation({Information{}}); },
         false},
    };
    for (const Case& reason : cases)
    {
        CAPTURE(reason.name);
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(3, 2);
        order.nodes[0].actions.push_back(MakeAction("a1", EBlockingType::None));
        bench.Order(order);
        bench.Clear();
        VehicleActions out;
        reason.change(bench, out);
        const std::size_t sent = bench.GetPublishedStates().size() + Pick<PublishMessage>(out).size();
        CHECK(sent == (reason.bSends ? 1 : 0));
    }
}

TEST_CASE("4.6 States are at least the minimum interval apart, and the last state has the last change")
{
    VehicleSessionFixture bench(MakeSlowStates());
    bench.Advance(std::chrono::seconds(1));
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.GetPublishedStates().size() == 1);
    for (int i = 0; i < 7; ++i)
    {
        bench.Advance(std::chrono::milliseconds(7));
        bench.Drive(i % 2 == 0);
    }
    CHECK(bench.GetPublishedStates().size() == 1);
    bench.Advance(std::chrono::milliseconds(1));
    VehicleActions out;
    bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
    REQUIRE(Pick<PublishMessage>(out).size() == 1);
    const auto state = Vda5050Codec().Decode<StateMessage>(Pick<PublishMessage>(out)[0].message.payload);
    CHECK(state->bDriving);
}

TEST_CASE("4.6 The factsheet states the intervals that the vehicle keeps")
{
    VehicleOptions options = MakeSlowStates();
    options.maximumStateInterval = std::chrono::seconds(10);
    options.visualizationInterval = std::chrono::milliseconds(250);
    VehicleSessionFixture bench(options);
    bench.Instant("factsheetRequest", "i1");
    const MqttMessage message = Pick<PublishMessage>(bench.GetOutput()).front().message;
    CHECK(message.bRetained);
    const auto factsheet = Vda5050Codec().Decode<FactsheetMessage>(message.payload);
    REQUIRE(factsheet.has_value());
    const ProtocolTiming& timing = factsheet->protocolLimits.timing;
    CHECK(timing.minStateInterval == 0.05);
    CHECK(timing.defaultStateInterval == 10.0);
    CHECK(timing.visualizationInterval == 0.25);
}

TEST_CASE("4.4 newBaseRequest while the base runs low and a horizon is left")
{
    struct Case
    {
        std::size_t nodes;
        std::size_t released;
        bool bRequest;
    };
    const std::vector<Case> cases{{5, 4, false}, {5, 2, true}, {5, 1, true}, {5, 5, false}, {2, 2, false}};
    for (const Case& base : cases)
    {
        CAPTURE(base.nodes, base.released);
        VehicleSessionFixture bench;
        bench.Order(MakeOrder(base.nodes, base.released));
        CHECK(bench.GetPublishedState().bNewBaseRequest == base.bRequest);
    }
}

TEST_CASE("4.4 A vehicle without an order may be set to another node; one with an order may not")
{
    VehicleSessionFixture bench;
    VehicleActions out;
    CHECK(bench.GetSession().TrySetLastNode("N5", bench.GetNow(), out));
    CHECK(Pick<PublishMessage>(out).size() == 1);
    CHECK(bench.GetSession().GetState().lastNodeID == "N5");
    bench.Order(MakeOrder(2, 2));
    CHECK_FALSE(bench.GetSession().TrySetLastNode("N5", bench.GetNow(), out));
    CHECK(bench.GetSession().GetState().lastNodeID == "N0");
}

TEST_CASE("8.4 How long an error of the session is reported")
{
    struct Case
    {
        const char* name;
        std::function<void(VehicleSessionFixture&)> cause;
        std::string_view errorType;
        bool bEndsWithMode;
        bool bEndsWithInstantAction;
    };
    const std::vector<Case> cases{
        {"an undecodable order",
         [](VehicleSessionFixture& bench) { bench.Payload(ETopic::Order, "{"); },
         ErrorTypes::VALIDATION_ERROR,
         false,
         false},
        {"an order of another major version",
         [](VehicleSessionFixture& bench) {
             OrderMessage order = MakeOrder(2, 2);
             order.header = Header{1, bench.GetNow().wall, "3.0.0", "ACS", "LR01"};
             bench.Payload(ETopic::Order, Vda5050Codec().Encode(order, EVda5050Version::Version200));
         },
         ErrorTypes::VALIDATION_ERROR,
         false,
         false},
        {"an order that begins elsewhere",
         [](VehicleSessionFixture& bench) {
             OrderMessage order = MakeOrder(2, 2);
             order.nodes[0].nodePosition->x = 99.0;
             bench.Order(order);
         },
         ErrorTypes::NO_ROUTE_ERROR,
         false,
         false},
        {"a cancel without an order",
         [](VehicleSessionFixture& bench) { bench.Instant("cancelOrder", "c1"); },
         ErrorTypes::NO_ORDER_TO_CANCEL,
         false,
         false},
        {"undecodable instant actions",
         [](VehicleSessionFixture& bench) { bench.Payload(ETopic::InstantActions, "{"); },
         ErrorTypes::VALIDATION_ERROR,
         false,
         true},
        {"an unknown instant action",
         [](VehicleSessionFixture& bench) { bench.Instant("makeCoffee", "i1"); },
         ErrorTypes::INSTANT_ACTION_ERROR,
         false,
         true},
        {"an order in SERVICE",
         [](VehicleSessionFixture& bench) {
             bench.Mode(EOperatingMode::Service);
             bench.Order(MakeOrder(2, 2));
         },
         ErrorTypes::ORDER_ERROR,
         true,
         false},
    };
    for (const Case& error : cases)
    {
        CAPTURE(error.name);
        VehicleSessionFixture bench;
        error.cause(bench);
        CHECK(bench.HasError(error.errorType));
        bench.Advance(std::chrono::hours(1));
        bench.Payload(ETopic::InstantActions, "{}"); // an undecodable message ends none of them
        CHECK(bench.HasError(error.errorType));
        bench.Mode(EOperatingMode::Automatic);
        CHECK(bench.GetSession().GetState().errors.empty() == false);
        const auto has = [&bench, &error] {
            const StateMessage state = bench.GetSession().GetState();
            return std::ranges::any_of(state.errors, [&error](const VehicleError& shown) {
                const std::string* topic = FindReferenceOrNull(shown, "topic");
                const bool bOther = shown.errorType == ErrorTypes::VALIDATION_ERROR && topic != nullptr
                    && *topic == "instantActions" && !error.bEndsWithInstantAction;
                return shown.errorType == error.errorType && !bOther;
            });
        };
        CHECK(has() == !error.bEndsWithMode);
        bench.Instant("stateRequest", "i9");
        CHECK(has() == !(error.bEndsWithMode || error.bEndsWithInstantAction));
        bench.Order(MakeOrder(2, 2));
        CHECK(bench.GetSession().GetState().errors.empty());
    }
}

TEST_CASE("8.4 Errors that the vehicle raises are not ended by an order and never end the order")
{
    VehicleSessionFixture bench;
    VehicleActions out;
    bench.GetSession().OnErrors({MakeOwnError()}, bench.GetNow(), out);
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.HasError("obstacle"));
    CHECK(bench.GetSession().IsOrderRunning());
    bench.GetSession().OnErrors({}, bench.GetNow(), out);
    CHECK(bench.GetSession().GetState().errors.empty());
}

TEST_CASE("8.4 A repeated rejection is one error, and many rejections do not fill the state")
{
    VehicleSessionFixture bench;
    bench.StandAt(5.0);
    for (int i = 0; i < 100; ++i)
    {
        bench.Order(MakeOrder(2, 2));
    }
    CHECK(bench.GetSession().GetState().errors.size() == 1);
    for (int i = 0; i < 100; ++i)
    {
        bench.Order(MakeOrder(2, 2, "order-" + std::to_string(i)));
    }
    CHECK(bench.GetSession().GetState().errors.size() == 16);
}

TEST_CASE("8.6 The effect of each operating mode on the order, on new orders and on instant actions")
{
    struct Case
    {
        EOperatingMode mode;
        bool bOrderKept;
        bool bDrives;
        bool bTakes;
    };
    const std::vector<Case> cases{
        {EOperatingMode::Automatic, true, true, true},
        {EOperatingMode::SemiAutomatic, true, true, true},
        {EOperatingMode::Manual, false, false, false},
        {EOperatingMode::Service, true, false, false},
        {EOperatingMode::TeachIn, true, false, false},
    };
    for (const Case& mode : cases)
    {
        CAPTURE(static_cast<int>(mode.mode));
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(3, 2);
        order.nodes[0].actions.push_back(MakeAction("runs", EBlockingType::None));
        order.nodes[1].actions.push_back(MakeAction("waits", EBlockingType::None));
        bench.Order(order);
        bench.Status("runs", EActionStatus::Running);
        bench.Clear();
        bench.Mode(mode.mode);
        const StateMessage state = bench.GetSession().GetState();
        CHECK(state.operatingMode == mode.mode);
        CHECK(state.nodeStates.empty() != mode.bOrderKept);
        CHECK(state.edgeStates.empty() != mode.bOrderKept);
        CHECK(state.orderID == "order-1");
        CHECK(state.lastNodeID == "N0");
        CHECK(bench.GetStatus("waits") == (mode.bOrderKept ? EActionStatus::Waiting : EActionStatus::Failed));
        CHECK(bench.GetStatus("runs") == (mode.bOrderKept ? EActionStatus::Running : EActionStatus::Failed));
        CHECK(Pick<StopDriving>(bench.GetOutput()).size() == (mode.bDrives ? 0 : 1));
        CHECK(Pick<OrderCleared>(bench.GetOutput()).size() == (mode.bOrderKept ? 0 : 1));
        bench.Instant("startPause", "p1");
        CHECK((bench.GetStatus("p1") == EActionStatus::Failed) != mode.bTakes);
        bench.Instant("stateRequest", "s1");
        CHECK(bench.GetStatus("s1") == EActionStatus::Finished);
        if (!mode.bTakes)
        {
            bench.Order(MakeOrder(2, 2, "order-2"));
            CHECK(bench.HasError(ErrorTypes::ORDER_ERROR));
            bench.Drive(false);
            bench.Clear();
            bench.Mode(EOperatingMode::Automatic);
            CHECK(Pick<DriveTo>(bench.GetOutput()).size() == (mode.bOrderKept ? 1 : 0));
        }
    }
}

TEST_CASE("8.6 Leaving MANUAL clears an order too, if there is one")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Mode(EOperatingMode::Manual);
    bench.Drive(false);
    bench.Mode(EOperatingMode::Service);
    CHECK(bench.GetSession().GetState().nodeStates.empty());
    CHECK_FALSE(bench.GetSession().IsOrderRunning());
}

TEST_CASE("2 Without the link the vehicle drives to the end of its base; after a reconnect it publishes its state")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(3, 3));
    VehicleActions out;
    bench.GetSession().OnLinkDown(bench.GetNow(), out);
    CHECK(Pick<CancelVehicleTimer>(out).size() == 3);
    bench.Clear();
    bench.Drive(true);
    bench.Reach(2);
    bench.Reach(4);
    bench.Drive(false);
    CHECK(Pick<PublishMessage>(bench.GetOutput()).empty());
    CHECK(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    out.clear();
    bench.GetSession().OnLinkUp(bench.GetNow(), out);
    const std::vector<PublishMessage> sent = Pick<PublishMessage>(out);
    REQUIRE(sent.size() == 3);
    CHECK(sent[0].message.topic == BuildTopic(MakeAddress(), ETopic::Connection));
    CHECK(sent[1].message.topic == BuildTopic(MakeAddress(), ETopic::Factsheet));
    const auto state = Vda5050Codec().Decode<StateMessage>(sent[2].message.payload);
    REQUIRE(state.has_value());
    CHECK(state->lastNodeID == "N2");
    CHECK(state->nodeStates.empty());
}

TEST_CASE("2 headerId is counted separately on each topic")
{
    VehicleSessionFixture bench;
    std::vector<std::uint32_t> ids;
    for (int i = 0; i < 3; ++i)
    {
        bench.Instant("factsheetRequest", "i" + std::to_string(i));
    }
    Vda5050Codec codec;
    for (const PublishMessage& publish : Pick<PublishMessage>(bench.GetOutput()))
    {
        const auto identity = codec.DecodeIdentity(publish.message.payload);
        REQUIRE(identity.has_value());
        ids.push_back(identity->header.headerID);
    }
    // Both topics had one message at the connect.
    CHECK(ids == std::vector<std::uint32_t>{1, 1, 2, 2, 3, 3});
}

} // namespace ACS::VDA5050::Test

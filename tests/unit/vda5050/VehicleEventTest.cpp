#include "Catch.hpp"
#include "RandomVehicle.hpp"
#include "StateSequenceChecker.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

using namespace std::chrono_literals;
using Names = std::vector<std::string>;

constexpr std::chrono::milliseconds INTERVAL = 50ms;

VehicleOptions MakeIntervalOptions()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.minimumStateInterval = INTERVAL;
    return options;
}

VehicleOptions MakeLineGuided()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.bStopsBetweenNodes = false;
    return options;
}

EActionStatus GetShownStatus(const StateMessage& state, std::string_view actionID)
{
    const auto found = std::ranges::find(state.actionStates, actionID, &ActionState::actionID);
    REQUIRE(found != state.actionStates.end());
    return found->actionStatus;
}

} // namespace

TEST_CASE("4.4 Arrival at a node with a HARD action, standstill and the end of the edge's actions are one state")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(3, 3);
    order.edges[0].actions = {
        MakeAction("reported", EBlockingType::None),
        MakeAction("unreported", EBlockingType::None),
        MakeAction("impossible", EBlockingType::None)};
    order.nodes[1].actions.push_back(MakeAction("n", EBlockingType::Hard));
    bench.Order(order);
    bench.Drive(true);
    bench.Status("reported", EActionStatus::Running);
    bench.Status("unreported", EActionStatus::Running);
    bench.Status("impossible", EActionStatus::Initializing);
    bench.Clear();
    bench.Reach(
        2,
        true,
        {{"reported", EActionStatus::Finished, "seen"},
         {"impossible", EActionStatus::Finished}, // not possible from INITIALIZING
         {"n", EActionStatus::Finished}});        // not an action of the edge
    REQUIRE(bench.GetPublishedStates().size() == 1);
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.lastNodeID == "N1");
    CHECK_FALSE(state.bDriving);
    CHECK(state.edgeStates.size() == 1);
    CHECK(state.actionStates[0].actionStatus == EActionStatus::Finished);
    CHECK(state.actionStates[0].resultDescription == "seen");
    CHECK(GetShownStatus(state, "unreported") == EActionStatus::Failed);
    CHECK(GetShownStatus(state, "impossible") == EActionStatus::Failed);
    CHECK(GetShownStatus(state, "n") == EActionStatus::Waiting);
    CHECK(
        Pick<StopAction>(bench.GetOutput())
        == std::vector{StopAction{"unreported", true}, StopAction{"impossible", true}});
    // The ended edge no longer holds up the HARD action of the node.
    CHECK(bench.GetStartedActions() == Names{"n"});
}

TEST_CASE("4.4 An edge action of a critical type that fails at a node where the vehicle stops requests no stop")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.criticalActionTypes = {"pick"};
    VehicleSessionFixture bench(options);
    OrderMessage order = MakeOrder(2, 2);
    order.edges[0].actions.push_back(MakeAction("e", EBlockingType::None));
    bench.Order(order);
    bench.Drive(true);
    bench.Status("e", EActionStatus::Running);
    bench.Reach(2, true);
    CHECK(bench.HasError(ErrorTypes::ACTION_ERROR));
    CHECK(Pick<StopDriving>(bench.GetOutput()).empty());
}

TEST_CASE("5.3 A pause that ends with the arrival at a node is in the state of the arrival")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Instant("startPause", "p1");
    bench.Clear();
    bench.Reach(2, true);
    REQUIRE(bench.GetPublishedStates().size() == 1);
    const StateMessage state = bench.GetPublishedState();
    CHECK(state.nodeStates.empty());
    CHECK_FALSE(state.bDriving);
    CHECK(state.bPaused == true);
    CHECK(GetShownStatus(state, "p1") == EActionStatus::Finished);
}

TEST_CASE("5.4 The state without nodes of a cancelled order shows cancelOrder FINISHED and a stationary vehicle")
{
    struct Case
    {
        const char* name;
        std::function<void(VehicleSessionFixture&)> arrive;
        bool bNodeBound;
    };
    const std::vector<Case> cases{
        {"stationary at the node, then the action ends",
         [](VehicleSessionFixture& bench) {
             bench.Reach(2, true);
             CHECK(bench.GetStatus("c1") == EActionStatus::Running);
             CHECK_FALSE(bench.GetPublishedState().bDriving);
             bench.Status("n", EActionStatus::Failed);
         },
         true},
        {"the action ends, then stationary at the node",
         [](VehicleSessionFixture& bench) {
             bench.Status("n", EActionStatus::Failed);
             bench.Reach(2, true);
         },
         true},
        {"the node first, then stationary",
         [](VehicleSessionFixture& bench) {
             bench.Status("n", EActionStatus::Failed);
             bench.Reach(2);
             VehicleActions out;
             CHECK_FALSE(bench.GetSession().TryReachNode({2}, bench.GetNow(), out));
             bench.Drive(false);
         },
         true},
        {"the last node is passed while it brakes",
         [](VehicleSessionFixture& bench) {
             bench.Status("n", EActionStatus::Failed);
             bench.Reach(2);
             bench.Drive(false);
         },
         false},
    };
    for (const Case& cancel : cases)
    {
        CAPTURE(cancel.name);
        VehicleSessionFixture bench(cancel.bNodeBound ? MakeLineGuided() : VehicleSessionFixture::MakeOptions());
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[0].actions.push_back(MakeAction("n", EBlockingType::None));
        bench.Order(order);
        bench.Status("n", EActionStatus::Running);
        bench.Drive(true);
        bench.Clear();
        bench.Instant("cancelOrder", "c1");
        cancel.arrive(bench);
        const std::vector<StateMessage> states = bench.GetPublishedStates();
        for (const StateMessage& state : states)
        {
            CHECK((GetShownStatus(state, "c1") == EActionStatus::Finished) == state.nodeStates.empty());
            CHECK_FALSE((state.nodeStates.empty() && state.bDriving));
        }
        CHECK(states.back().nodeStates.empty());
        CHECK_FALSE(states.back().bDriving);
        CHECK(states.back().lastNodeID == "N1");
        CHECK(states.back().lastNodeSequenceID == 2);
        CHECK(Pick<OrderCleared>(bench.GetOutput()).size() == 1);
    }
}

TEST_CASE("5.4.4 A cancelled vehicle on its last leg shows the edge until the edge's actions have ended")
{
    VehicleSessionFixture bench(MakeLineGuided());
    OrderMessage order = MakeOrder(3, 3);
    order.edges[0].actions.push_back(MakeAction("e", EBlockingType::None));
    bench.Order(order);
    bench.Drive(true);
    bench.Status("e", EActionStatus::Running);
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetPublishedState().edgeStates.size() == 1);
    bench.Status("e", EActionStatus::Failed);
    CHECK(bench.GetPublishedState().edgeStates.empty());
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1"});
}

TEST_CASE("4.6 No state is sent before the minimum interval has passed: not on a reconnect, not by any timer")
{
    struct Case
    {
        const char* name;
        std::function<void(VehicleSessionFixture&, VehicleActions&)> cause;
    };
    const std::vector<Case> cases{
        {"reconnect",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnLinkDown(bench.GetNow(), out);
             bench.GetSession().OnLinkUp(bench.GetNow(), out);
         }},
        {"maximum interval",
         [](VehicleSessionFixture& bench, VehicleActions& out) {
             bench.GetSession().OnTimer(EVehicleTimer::MaximumStateInterval, bench.GetNow(), out);
         }},
        {"stateRequest",
         [](VehicleSessionFixture& bench, VehicleActions&) {
             bench.Instant("stateRequest", "s1");
         }},
    };
    for (const Case& early : cases)
    {
        CAPTURE(early.name);
        VehicleSessionFixture bench(MakeIntervalOptions());
        bench.Advance(INTERVAL - 1ms);
        VehicleActions out;
        early.cause(bench, out);
        out.insert(out.end(), bench.GetOutput().begin(), bench.GetOutput().end());
        const std::string topic = BuildTopic(MakeAddress(), ETopic::State);
        const auto countStates = [&topic](const VehicleActions& actions) {
            const std::vector<PublishMessage> sent = Pick<PublishMessage>(actions);
            return std::ranges::count(sent, topic, [](const PublishMessage& publish) { return publish.message.topic; });
        };
        CHECK(countStates(out) == 0);
        const std::vector<StartVehicleTimer> timers = Pick<StartVehicleTimer>(out);
        const StartVehicleTimer wait{EVehicleTimer::MinimumStateInterval, 1ms};
        CHECK(std::ranges::find(timers, wait) != timers.end());
        bench.Advance(1ms);
        out.clear();
        bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
        CHECK(countStates(out) == 1);
    }
}

TEST_CASE("4.6 A change that ends within the minimum interval is shown all the same: instant actions and rejections")
{
    VehicleSessionFixture bench(MakeIntervalOptions());
    bench.Advance(10ms);
    bench.Instant("stateRequest", "s1");
    bench.Instant("makeCoffee", "i1");
    OrderMessage elsewhere = MakeOrder(2, 2, "order-elsewhere");
    elsewhere.nodes[0].nodePosition->x = 99.0;
    bench.Order(elsewhere);
    bench.Instant("stateRequest", "s2");
    OrderMessage repeated = MakeOrder(1, 1, "order-repeated");
    repeated.nodes[0].actions.push_back(MakeAction("s2", EBlockingType::None));
    bench.Order(repeated);
    CHECK(bench.GetSession().GetState().orderID.empty()); // s2 is still to be shown
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.GetPublishedStates().empty());
    bench.Advance(INTERVAL);
    VehicleActions out;
    bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
    const StateMessage state = bench.GetSession().GetState();
    CHECK(state.orderID == "order-1");
    CHECK(GetShownStatus(state, "s1") == EActionStatus::Finished);
    CHECK(GetShownStatus(state, "i1") == EActionStatus::Failed);
    const auto takeErrors = [&out] {
        const auto published = Pick<PublishMessage>(std::exchange(out, {}));
        REQUIRE(published.size() == 1);
        const auto shown = Vda5050Codec().Decode<StateMessage>(published[0].message.payload);
        REQUIRE(shown.has_value());
        Names types;
        std::ranges::transform(shown->errors, std::back_inserter(types), &VehicleError::errorType);
        return types;
    };
    CHECK(Pick<StartVehicleTimer>(out).back().timer == EVehicleTimer::MinimumStateInterval);
    const Names shownErrors = takeErrors();
    CHECK(std::ranges::count(shownErrors, ErrorTypes::INSTANT_ACTION_ERROR) == 1);
    CHECK(std::ranges::count(shownErrors, ErrorTypes::NO_ROUTE_ERROR) == 1);
    // They have ended with the order: the next state has none of them.
    bench.Advance(INTERVAL);
    bench.GetSession().OnTimer(EVehicleTimer::MinimumStateInterval, bench.GetNow(), out);
    CHECK(takeErrors().empty());
    bench.Reach(2, true);
    bench.StandAt(10.0);
    OrderMessage next = MakeOrder(1, 1, "order-2");
    next.nodes[0].nodePosition->x = 10.0;
    bench.Order(next);
    CHECK(bench.GetSession().GetState().orderID == "order-2");
    CHECK(bench.GetSession().GetState().actionStates.empty());
    CHECK(bench.GetSession().GetState().errors.empty());
}

TEST_CASE("The checker of the random tests reports each violation")
{
    struct Case
    {
        const char* name;
        std::function<void(StateMessage&)> change;
        std::chrono::milliseconds delay;
        const char* fault; ///< nullptr: none.
    };
    OrderMessage order = MakeOrder(3, 3);
    order.edges[0].actions.push_back(MakeAction("e", EBlockingType::None));
    order.nodes[1].actions.push_back(MakeAction("n", EBlockingType::Soft));
    const auto setStatus = [](StateMessage& state, std::size_t index, EActionStatus status) {
        state.actionStates.at(index).actionStatus = status;
    };
    const auto reach = [](StateMessage& state) {
        state.lastNodeID = "N1";
        state.lastNodeSequenceID = 2;
        state.nodeStates.erase(state.nodeStates.begin());
        state.edgeStates.erase(state.edgeStates.begin());
    };
    const std::vector<Case> cases{
        {"valid",
         [&](StateMessage& state) {
             reach(state);
             setStatus(state, 0, EActionStatus::Finished);
             state.bDriving = false;
         },
         INTERVAL,
         nullptr},
        {"too early", [](StateMessage&) {}, INTERVAL - 1ms, "the minimum interval is kept"},
        {"driving at a node with a SOFT action",
         [&](StateMessage& state) {
             reach(state);
             setStatus(state, 0, EActionStatus::Finished);
         },
         INTERVAL,
         "a vehicle that stops at its node is stationary"},
        {"driving at the end",
         [&](StateMessage& state) {
             state.nodeStates.clear();
             state.edgeStates.clear();
             setStatus(state, 0, EActionStatus::Finished);
             setStatus(state, 1, EActionStatus::Finished);
         },
         INTERVAL,
         "a vehicle that stops at its node is stationary"},
        {"an action outlives its edge",
         [&](StateMessage& state) {
             reach(state);
             state.bDriving = false;
         },
         INTERVAL,
         "an edge action ends with its edge"},
        {"no nodes before the end of the cancel",
         [&](StateMessage& state) {
             state.nodeStates.clear();
             state.edgeStates.clear();
             state.bDriving = false;
             setStatus(state, 0, EActionStatus::Failed);
         },
         INTERVAL,
         "a cancel ends when no nodes are left"},
        {"another order", [](StateMessage& state) { state.orderID = "x"; }, INTERVAL, "the order is the accepted one"},
    };
    for (const Case& sequence : cases)
    {
        CAPTURE(sequence.name);
        Testing::StateSequenceChecker checker(INTERVAL);
        VehicleSessionFixture bench;
        bench.Order(order);
        bench.Drive(true);
        StateMessage state = bench.GetSession().GetState();
        state.actionStates.push_back(ActionState{"c1", "cancelOrder", {}, EActionStatus::Running, {}});
        checker.AddOrder(order);
        checker.AddInstantAction("c1");
        checker.AddCancel("c1");
        checker.Check(state, bench.GetNow().steady);
        CHECK(checker.GetFaults().empty());
        sequence.change(state);
        checker.Check(state, bench.GetNow().steady + sequence.delay);
        const Names faults = checker.GetFaults();
        CHECK(faults.empty() == (sequence.fault == nullptr));
        const bool bFound = sequence.fault == nullptr
            || std::ranges::any_of(faults, [&](const std::string& fault) { return fault.ends_with(sequence.fault); });
        CHECK(bFound);
        checker.CheckComplete(bench.GetSession().GetState()); // without the cancel
        CHECK(checker.GetFaults().size() == faults.size() + 1);
        checker.CheckEnded();
        CHECK(checker.GetFaults().size() == faults.size() + 2);
    }
}

TEST_CASE("4.6 In 10000 states of random orders and cancels each event is in one state and nothing is lost")
{
    constexpr std::size_t STATES = 10'000;
    constexpr int STEPS = 1'000;
    std::size_t count = 0;
    std::size_t stops = 0;
    std::size_t cancels = 0;
    for (std::uint64_t seed = 1; count < STATES; ++seed)
    {
        CAPTURE(seed);
        RandomVehicle vehicle(seed);
        for (int step = 0; step < STEPS; ++step)
        {
            vehicle.Step();
        }
        vehicle.Finish();
        REQUIRE(vehicle.GetChecker().GetFaults() == Names{});
        count += vehicle.GetChecker().GetCount();
        stops += vehicle.GetChecker().CountStops();
        cancels += vehicle.GetChecker().CountCancels();
    }
    INFO(stops << " stops, " << cancels << " cancels");
    CHECK(stops > STATES / 50);
    CHECK(cancels > STATES / 50);
}

} // namespace ACS::VDA5050::Test

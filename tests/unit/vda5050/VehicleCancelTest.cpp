#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <functional>

namespace ACS::VDA5050::Test
{

namespace
{

using Names = std::vector<std::string>;

VehicleOptions MakeNodeBound()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.bStopsBetweenNodes = false;
    return options;
}

} // namespace

TEST_CASE("5.4 cancelOrder in every situation of a vehicle that may stop anywhere")
{
    struct Case
    {
        const char* name;
        std::function<void(VehicleSessionFixture&)> before; ///< After an order of three nodes, two of them released.
        EActionStatus status;                               ///< Of cancelOrder, at once.
        std::size_t nodesLeft;                              ///< In the state that follows at once.
    };
    const std::vector<Case> cases{
        {"sent on the way, not yet known to move",
         [](VehicleSessionFixture& bench) { bench.Clear(); },
         EActionStatus::Running,
         2},
        {"between two nodes, driving",
         [](VehicleSessionFixture& bench) { bench.Drive(true); },
         EActionStatus::Running,
         2},
        {"at the end of the base, with a horizon",
         [](VehicleSessionFixture& bench) {
             bench.Drive(true);
             bench.Reach(2);
             bench.Drive(false);
         },
         EActionStatus::Finished,
         0},
        {"paused between two nodes",
         [](VehicleSessionFixture& bench) {
             bench.Drive(true);
             bench.Instant("startPause", "p1");
             bench.Drive(false);
         },
         EActionStatus::Finished,
         0},
        {"pausing",
         [](VehicleSessionFixture& bench) {
             bench.Drive(true);
             bench.Instant("startPause", "p1");
         },
         EActionStatus::Running,
         2},
        {"cancelled already",
         [](VehicleSessionFixture& bench) {
             bench.Instant("cancelOrder", "c0");
             bench.Drive(false);
         },
         EActionStatus::Failed,
         0},
        {"being cancelled",
         [](VehicleSessionFixture& bench) {
             bench.Drive(true);
             bench.Instant("cancelOrder", "c0");
         },
         EActionStatus::Running,
         2},
        {"cleared by MANUAL",
         [](VehicleSessionFixture& bench) {
             bench.Mode(EOperatingMode::Manual);
             bench.Mode(EOperatingMode::Automatic);
         },
         EActionStatus::Failed,
         0},
    };
    for (const Case& situation : cases)
    {
        CAPTURE(situation.name);
        VehicleSessionFixture bench;
        bench.Order(MakeOrder(3, 2));
        situation.before(bench);
        const std::size_t errorsBefore = bench.GetSession().GetState().errors.size();
        bench.Instant("cancelOrder", "c1");
        CHECK(bench.GetStatus("c1") == situation.status);
        CHECK(bench.GetSession().GetState().nodeStates.size() == situation.nodesLeft);
        const bool bRefused = situation.status == EActionStatus::Failed;
        CHECK(bench.GetSession().GetState().errors.size() == errorsBefore + (bRefused ? 1 : 0));
        // When the vehicle is reported stationary everything but the ids and lastNodeId is empty.
        bench.Drive(true);
        bench.Drive(false);
        const StateMessage state = bench.GetSession().GetState();
        CHECK(state.nodeStates.empty());
        CHECK(state.edgeStates.empty());
        CHECK(state.orderID == "order-1");
        CHECK_FALSE(state.lastNodeID.empty());
        CHECK(bench.GetStatus("c1") == (bRefused ? EActionStatus::Failed : EActionStatus::Finished));
        CHECK(Pick<OrderCompleted>(bench.GetOutput()).empty());
    }
}

TEST_CASE("5.4.3 The effect of a cancel on an order action, by its status")
{
    struct Case
    {
        const char* name;
        std::vector<EActionStatus> before;
        EActionStatus after;
        bool bStopRequested;
    };
    const std::vector<Case> cases{
        {"initializing", {EActionStatus::Initializing}, EActionStatus::Initializing, true},
        {"running", {EActionStatus::Running}, EActionStatus::Running, true},
        {"paused", {EActionStatus::Running, EActionStatus::Paused}, EActionStatus::Failed, true},
        {"finished", {EActionStatus::Running, EActionStatus::Finished}, EActionStatus::Finished, false},
        {"failed", {EActionStatus::Running, EActionStatus::Failed}, EActionStatus::Failed, false},
    };
    for (const Case& action : cases)
    {
        CAPTURE(action.name);
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(3, 2);
        order.nodes[0].actions.push_back(MakeAction("first", EBlockingType::Hard));
        order.nodes[2].actions.push_back(MakeAction("horizon", EBlockingType::Hard));
        bench.Order(order);
        for (const EActionStatus status : action.before)
        {
            bench.Status("first", status);
        }
        bench.Instant("cancelOrder", "c1");
        CHECK(bench.GetStatus("first") == action.after);
        CHECK(bench.GetStatus("horizon") == EActionStatus::Failed);
        CHECK(Pick<StopAction>(bench.GetOutput()).size() == (action.bStopRequested ? 1 : 0));
        if (!IsTerminal(action.after))
        {
            // It cannot be interrupted: the cancel ends with it, and its result is kept.
            CHECK(bench.GetStatus("c1") == EActionStatus::Running);
            if (action.after != EActionStatus::Running)
            {
                bench.Status("first", EActionStatus::Running);
            }
            bench.Status("first", EActionStatus::Finished);
        }
        bench.Drive(false);
        CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
        CHECK(bench.GetSession().GetState().actionStates.size() == 3);
    }
}

TEST_CASE("5.4.4 A vehicle that stops between nodes keeps its nodes until it is stationary")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(3, 3));
    bench.Clear();
    // A drive was started and has not been confirmed: the vehicle may be on its way.
    bench.Instant("cancelOrder", "c1");
    CHECK(Pick<StopDriving>(bench.GetOutput()).size() == 1);
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1", "N2"});
    bench.Drive(true);
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1", "N2"});
    // It passes the node while it brakes.
    bench.Reach(2);
    CHECK(bench.GetPublishedState().lastNodeID == "N1");
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N2"});
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    bench.Drive(false);
    CHECK(bench.GetPublishedState().nodeStates.empty());
    CHECK(bench.GetPublishedState().lastNodeID == "N1");
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
}

TEST_CASE("5.4.4 A vehicle that stops only on nodes and is paused between two of them drives on after stopPause")
{
    VehicleSessionFixture bench(MakeNodeBound());
    bench.Order(MakeOrder(4, 4));
    bench.Drive(true);
    bench.Instant("startPause", "p1");
    bench.Drive(false);
    bench.Clear();
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    CHECK(ListNodes(bench.GetPublishedState()) == Names{"N1"});
    CHECK(bench.GetPublishedState().bPaused == true);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    bench.Instant("stopPause", "p2");
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].node.nodeID == "N1");
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].edge.edgeID == "E0");
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].bStopAtNode);
    bench.Drive(true);
    bench.Reach(2);
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    bench.Drive(false);
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(bench.GetPublishedState().nodeStates.empty());
    CHECK(bench.GetPublishedState().lastNodeID == "N1");
}

TEST_CASE("5.4.4 A vehicle that stops only on nodes and is stationary on one stays there")
{
    VehicleSessionFixture bench(MakeNodeBound());
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[0].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    bench.Order(order);
    bench.Status("a1", EActionStatus::Running);
    bench.Instant("cancelOrder", "c1");
    bench.Status("a1", EActionStatus::Failed);
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
}

TEST_CASE("5.4.6 A cancelled order cannot be cancelled again, and a new one can follow it")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Instant("cancelOrder", "c1");
    bench.Drive(false);
    bench.Order(MakeOrder(2, 2, "order-2"));
    CHECK(bench.GetPublishedState().orderID == "order-2");
    bench.Instant("cancelOrder", "c2");
    bench.Drive(false);
    CHECK(bench.GetStatus("c2") == EActionStatus::Finished);
}

TEST_CASE("5.4.8 While a cancel runs: orders and updates are refused, requests and pauses are answered")
{
    struct Case
    {
        const char* actionType;
        EActionStatus status;
    };
    const std::vector<Case> cases{
        {"stateRequest", EActionStatus::Finished},
        {"factsheetRequest", EActionStatus::Finished},
        {"startPause", EActionStatus::Running},
        {"stopPause", EActionStatus::Finished},
        {"cancelOrder", EActionStatus::Running},
    };
    for (const Case& instant : cases)
    {
        CAPTURE(instant.actionType);
        VehicleSessionFixture bench;
        bench.Order(MakeOrder(3, 3));
        bench.Drive(true);
        bench.Instant("cancelOrder", "c1");
        bench.Order(MakeOrder(2, 2, "order-2"));
        CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
        bench.Instant(instant.actionType, "i1");
        CHECK(bench.GetStatus("i1") == instant.status);
        bench.Drive(false);
        CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
        CHECK(bench.GetStatus("i1") == EActionStatus::Finished);
        CHECK(bench.GetPublishedState().orderID == "order-1");
    }
}

TEST_CASE("5.4.9 waitForTrigger fails when its order is cancelled; instant actions continue")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    AgvAction report;
    report.actionType = "logReport";
    report.actionScopes = {EActionScope::Instant};
    AgvAction trigger;
    trigger.actionType = "waitForTrigger";
    trigger.actionScopes = {EActionScope::Node};
    trigger.actionParameters = {AgvActionParameter{"triggerType", EValueDataType::String, {}, false}};
    options.factsheet.protocolFeatures.agvActions = {report, trigger};
    VehicleSessionFixture bench(options);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions.push_back(MakeAction("wait", EBlockingType::Hard, "waitForTrigger"));
    order.nodes[0].actions[0].actionParameters = {{"triggerType", Core::JsonText::FromString("LOCAL")}};
    bench.Order(order);
    bench.Status("wait", EActionStatus::Running);
    bench.Advance(std::chrono::hours(24)); // no timeout of the vehicle's own
    CHECK(bench.GetStatus("wait") == EActionStatus::Running);
    bench.Instant("logReport", "log", {{"reason", Core::JsonText::FromString("test")}});
    bench.Status("log", EActionStatus::Running);
    bench.Instant("cancelOrder", "c1");
    CHECK(Pick<StopAction>(bench.GetOutput()) == std::vector{StopAction{"wait", false}});
    bench.Status("wait", EActionStatus::Failed);
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK(bench.GetStatus("log") == EActionStatus::Running);
}

TEST_CASE(
    "8.6 A vehicle that forgets everything in MANUAL shows no order, no ended action, and its node only if it is on it")
{
    VehicleOptions options = MakeNodeBound();
    options.bForgetsInManual = true;
    for (const bool bLeft : {false, true})
    {
        CAPTURE(bLeft);
        VehicleSessionFixture bench(options);
        OrderMessage order = MakeOrder(3, 3);
        order.nodes[0].actions.push_back(MakeAction("begun", bLeft ? EBlockingType::None : EBlockingType::Hard));
        bench.Order(order);
        bench.Status("begun", EActionStatus::Running);
        bench.Instant("startPause", "pause");
        bench.Mode(EOperatingMode::Manual);
        const StateMessage state = bench.GetPublishedState();
        CHECK(state.orderID.empty());
        CHECK(state.nodeStates.empty());
        CHECK(state.edgeStates.empty());
        CHECK(state.lastNodeID == (bLeft ? "" : "N0"));
        CHECK(std::ranges::none_of(state.actionStates, [](const ActionState& action) {
            return action.actionID == "begun";
        }));
        CHECK(bench.GetPublishedState().errors.empty());
        bench.Drive(false);
        bench.Instant("stopPause", "resume");
        bench.Mode(EOperatingMode::Automatic);
        order.orderID = "order-2";
        bench.Order(order);
        CHECK(bench.GetSession().GetState().orderID == "order-2");
        CHECK(bench.GetSession().GetState().lastNodeID == "N0");
    }
}

TEST_CASE(
    "5.4.7 The heading counts for an order after a cancel between two nodes or in MANUAL, not after one on a node")
{
    struct Case
    {
        const char* name;
        bool bLeft;
        bool bManual;
    };
    const Case cancel = GENERATE(
        Case{"on the node", false, false},
        Case{"between two nodes", true, false},
        Case{"on the node, in MANUAL", false, true});
    CAPTURE(cancel.name);
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {MakeAction("a1", cancel.bLeft ? EBlockingType::None : EBlockingType::Hard)};
    bench.Order(order);
    bench.Status("a1", EActionStatus::Running);
    bench.StandAt(0.0, 1.5);
    if (cancel.bManual)
    {
        bench.Mode(EOperatingMode::Manual);
        bench.Mode(EOperatingMode::Automatic);
    }
    else
    {
        bench.Instant("cancelOrder", "c1");
        bench.Status("a1", EActionStatus::Failed);
        bench.Drive(false);
        REQUIRE(bench.GetStatus("c1") == EActionStatus::Finished);
    }
    OrderMessage next = MakeOrder(2, 2, "order-2");
    next.nodes[0].nodePosition->theta = 0.0;
    next.nodes[0].nodePosition->allowedDeviationTheta = 0.1;
    bench.Order(next);
    const bool bRefused = cancel.bLeft || cancel.bManual;
    CHECK(bench.HasError(ErrorTypes::NO_ROUTE_ERROR) == bRefused);
    CHECK(bench.GetPublishedState().orderID == (bRefused ? "order-1" : "order-2"));
}

TEST_CASE("4.4 The distance since the last node ends with an order that begins at another node")
{
    VehicleSessionFixture bench;
    AgvPosition position;
    position.bPositionInitialized = true;
    position.mapID = "floor";
    bench.GetSession().OnPosition(position, Velocity{}, 4.0);
    REQUIRE(bench.GetSession().GetState().distanceSinceLastNode == 4.0);
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].nodeID = "N9";
    order.edges[0].startNodeID = "N9";
    bench.Order(order);
    CHECK(bench.GetSession().GetState().lastNodeID == "N9");
    CHECK_FALSE(bench.GetSession().GetState().distanceSinceLastNode.has_value());
}

} // namespace ACS::VDA5050::Test

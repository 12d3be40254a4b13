#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/ActionMachine.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>
#include <optional>

namespace ACS::VDA5050::Test
{

namespace
{

using Names = std::vector<std::string>;

VehicleOptions MakeCapable()
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    return options;
}

/// Reaches the end of two nodes.
void Complete(VehicleSessionFixture& bench, const OrderMessage& order)
{
    bench.Order(order);
    bench.Drive(true);
    bench.Reach(2);
    bench.Drive(false);
    REQUIRE(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
    bench.Clear();
}

/// At x 70 and on N7.
std::vector<ActionParameter> MakePose(const char* mapID)
{
    std::vector<ActionParameter> pose;
    for (const auto& [key, value] :
         std::vector<std::pair<const char*, double>>{{"x", 70.0}, {"y", 0.0}, {"theta", 0.0}})
    {
        pose.push_back({key, Core::JsonText::FromNumber(value)});
    }
    pose.push_back({"mapId", Core::JsonText::FromString(mapID)});
    pose.push_back({"lastNodeId", Core::JsonText::FromString("N7")});
    return pose;
}

const VehicleError* FindErrorOrNull(const StateMessage& state, std::string_view errorType)
{
    const auto found = std::ranges::find(state.errors, errorType, &VehicleError::errorType);
    return found == state.errors.end() ? nullptr : &*found;
}

} // namespace

TEST_CASE("4.3 The stitching node keeps its first contents, whatever the update contains")
{
    VehicleSessionFixture bench;
    OrderBuilder builder = MakeBuilder(3);
    OrderMessage order = *builder.MakeOrder(2, 0);
    order.nodes[1].actions.push_back(MakeAction("first", EBlockingType::None));
    order.nodes[1].nodePosition->allowedDeviationXY = 0.25;
    bench.Order(order);
    bench.Clear();
    OrderMessage update = *builder.MakeUpdate(3);
    update.nodes[0].actions.push_back(MakeAction("second", EBlockingType::Hard));
    update.nodes[0].nodePosition->allowedDeviationXY = 3.0;
    bench.Order(update);
    CHECK(bench.GetPublishedState().orderUpdateID == 1);
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    const DriveTo drive = Pick<DriveTo>(bench.GetOutput())[0];
    CHECK(drive.node.nodePosition->allowedDeviationXY == 0.25);
    CHECK_FALSE(drive.bStopAtNode);
    bench.Reach(2);
    CHECK(bench.GetStartedActions() == Names{"first"});
    CHECK(bench.GetSession().GetState().actionStates.size() == 1);
}

TEST_CASE("4.3 An update may replace, shorten or drop the horizon; what is assigned keeps its sequenceId")
{
    struct Case
    {
        std::size_t released;
        std::size_t horizon;
        Names nodes;
    };
    const std::vector<Case> cases{
        {2, 3, {"N1", "N2", "N3", "N4"}},
        {2, 1, {"N1", "N2"}},
        {2, 0, {"N1"}},
        {4, 0, {"N1", "N2", "N3"}},
    };
    for (const Case& horizon : cases)
    {
        CAPTURE(horizon.released, horizon.horizon);
        VehicleSessionFixture bench;
        OrderBuilder builder = MakeBuilder(5);
        OrderMessage order = *builder.MakeOrder(2, 2);
        order.nodes[3].actions.push_back(MakeAction("dropped", EBlockingType::None));
        bench.Order(order);
        bench.Order(*builder.MakeUpdate(horizon.released, horizon.horizon));
        const StateMessage state = bench.GetPublishedState();
        CHECK(ListNodes(state) == horizon.nodes);
        CHECK(state.actionStates.empty());
        CHECK(state.edgeStates.size() == horizon.nodes.size());
        for (std::size_t index = 0; index < state.nodeStates.size(); ++index)
        {
            CHECK(state.nodeStates[index].sequenceID == 2 * (index + 1));
            CHECK(state.edgeStates[index].sequenceID == 2 * index + 1);
            CHECK(state.nodeStates[index].bReleased == (index + 1 < horizon.released));
        }
    }
}

TEST_CASE("4.3 New actions at the node of the vehicle come with a further node of the same nodeId")
{
    VehicleSessionFixture bench;
    OrderBuilder builder = MakeBuilder(2);
    Complete(bench, *builder.MakeOrder(2));
    OrderNode again = builder.GetNodes()[1];
    again.actions.push_back(MakeAction("more", EBlockingType::Hard));
    OrderEdge logical;
    logical.edgeID = "stay";
    REQUIRE(builder.Append({again}, {logical}).has_value());
    bench.Order(*builder.MakeUpdate(3));
    REQUIRE(Pick<DriveTo>(bench.GetOutput()).size() == 1);
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].edge.startNodeID == "N1");
    CHECK(Pick<DriveTo>(bench.GetOutput())[0].edge.endNodeID == "N1");
    bench.Reach(4);
    CHECK(bench.GetSession().GetState().lastNodeID == "N1");
    CHECK(bench.GetSession().GetState().lastNodeSequenceID == 4);
    CHECK(bench.GetStartedActions() == Names{"more"});
}

TEST_CASE("4.4 4.5 A vehicle that never had an order and is on no node reports empty ids")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.initialNodeID.clear();
    VehicleSessionFixture bench(options);
    const StateMessage state = bench.GetSession().GetState();
    CHECK(state.orderID.empty());
    CHECK(state.orderUpdateID == 0);
    CHECK(state.lastNodeID.empty());
    CHECK(state.lastNodeSequenceID == 0);
    CHECK(state.nodeStates.empty());
    CHECK(state.actionStates.empty());
    CHECK(state.bNewBaseRequest == false);
}

TEST_CASE("5.1 With which status an action may begin")
{
    for (const EActionStatus status :
         {EActionStatus::Waiting,
          EActionStatus::Initializing,
          EActionStatus::Running,
          EActionStatus::Paused,
          EActionStatus::Finished,
          EActionStatus::Failed})
    {
        CHECK(CanBeginWith(status) == (status != EActionStatus::Paused));
    }
}

TEST_CASE("5.2 An edge action that has not begun when the edge is left fails with a warning and never begins")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions.push_back(MakeAction("long", EBlockingType::None));
    order.edges[0].actions.push_back(MakeAction("late", EBlockingType::Hard));
    bench.Order(order);
    bench.Status("long", EActionStatus::Running);
    CHECK(bench.GetStartedActions() == Names{"long"});
    bench.Reach(2); // moved there by hand
    CHECK(bench.GetStatus("late") == EActionStatus::Failed);
    CHECK(bench.HasError(ErrorTypes::ACTION_ERROR));
    bench.Status("long", EActionStatus::Finished);
    CHECK(bench.GetStartedActions() == Names{"long"});
    CHECK(Pick<OrderCompleted>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.3 An action that is being initialised is paused too, one that has not begun stays WAITING")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {MakeAction("init", EBlockingType::Hard), MakeAction("later", EBlockingType::Hard)};
    bench.Order(order);
    bench.Status("init", EActionStatus::Initializing);
    bench.Instant("startPause", "p1");
    CHECK(Pick<PauseAction>(bench.GetOutput()) == std::vector{PauseAction{"init"}});
    bench.Status("init", EActionStatus::Paused);
    CHECK(bench.GetStatus("later") == EActionStatus::Waiting);
    bench.Instant("stopPause", "p2");
    bench.Status("init", EActionStatus::Initializing);
    CHECK(bench.GetStatus("init") == EActionStatus::Initializing);
}

TEST_CASE("5.4.7 After a cancel between two nodes an order may begin at a temporary node at the vehicle's position")
{
    VehicleSessionFixture bench;
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.StandAt(5.0);
    bench.Instant("cancelOrder", "c1");
    bench.Drive(false);
    OrderMessage next = MakeOrder(2, 2, "order-2");
    next.nodes[0].nodeID = "temporary";
    next.nodes[0].nodePosition->x = 5.0;
    next.edges[0].startNodeID = "temporary";
    bench.Order(next);
    CHECK(bench.GetPublishedState().orderID == "order-2");
    CHECK(bench.GetPublishedState().lastNodeID == "temporary");
}

TEST_CASE("5.5 Actions failed by a cancel stay reported when the order continues and drops its horizon again")
{
    VehicleSessionFixture bench;
    const auto make = [](std::uint32_t updateID, std::size_t released, const char* actionID) {
        OrderMessage order = MakeOrder(2, released);
        order.orderUpdateID = updateID;
        order.nodes[1].actions.push_back(MakeAction(actionID, EBlockingType::None));
        return order;
    };
    bench.Order(make(0, 1, "old"));
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("old") == EActionStatus::Failed);
    bench.Order(make(1, 1, "new"));
    bench.Order(make(2, 1, "old")); // its end is reported still: the id cannot come again
    CHECK(bench.HasError(ErrorTypes::VALIDATION_ERROR));
    bench.Order(make(3, 2, "newer"));
    CHECK(bench.GetPublishedState().orderUpdateID == 3);
    CHECK(bench.GetStatus("old") == EActionStatus::Failed);
    CHECK(bench.GetStatus("newer") == EActionStatus::Waiting);
    CHECK(bench.GetPublishedState().actionStates.size() == 3); // with the cancel
}

TEST_CASE("8.6 An update of an order that MANUAL has cleared is handled as after a cancel")
{
    struct Case
    {
        std::size_t releasedBefore; ///< Of the update's order: it begins at the last of them.
        double standsAt;
        std::string_view errorType;
    };
    const std::vector<Case> cases{
        {2, 0.0, ErrorTypes::ORDER_UPDATE_ERROR},
        {1, 5.0, ErrorTypes::NO_ROUTE_ERROR},
        {1, 0.0, {}},
    };
    for (const Case& cleared : cases)
    {
        CAPTURE(cleared.releasedBefore, cleared.standsAt);
        VehicleSessionFixture bench;
        bench.Order(MakeOrder(3, 2));
        bench.Mode(EOperatingMode::Manual);
        bench.StandAt(cleared.standsAt);
        bench.Drive(false);
        bench.Mode(EOperatingMode::Automatic);
        OrderBuilder builder = MakeBuilder(3);
        REQUIRE(builder.MakeOrder(cleared.releasedBefore).has_value());
        bench.Order(*builder.MakeUpdate(3));
        const StateMessage state = bench.GetPublishedState();
        CHECK(state.orderUpdateID == (cleared.errorType.empty() ? 1 : 0));
        REQUIRE(state.errors.size() == (cleared.errorType.empty() ? 0 : 1));
        if (!cleared.errorType.empty())
        {
            CHECK(state.errors[0].errorType == cleared.errorType);
        }
    }
}

TEST_CASE("5.6 A different action with the id of a reported one is an error; the same action again is not")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::None));
    bench.Order(order);
    bench.Instant("stateRequest", "s1");
    bench.Instant("stateRequest", "s1");
    CHECK(bench.GetPublishedState().errors.empty());
    for (const char* actionID : {"a1", "s1"})
    {
        bench.Instant("cancelOrder", actionID);
        const StateMessage state = bench.GetPublishedState();
        const VehicleError* error = FindErrorOrNull(state, ErrorTypes::INSTANT_ACTION_ERROR);
        REQUIRE(error != nullptr);
        CHECK(*FindReferenceOrNull(state.errors.back(), "actionId") == actionID);
        CHECK(state.actionStates.size() == 2);
    }
    CHECK(bench.GetStatus("a1") == EActionStatus::Waiting);
}

TEST_CASE("8.6 Actions that MANUAL ends report the reason, paused or not")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[0].actions = {MakeAction("paused", EBlockingType::None), MakeAction("runs", EBlockingType::None)};
    order.nodes[1].actions = {MakeAction("waits", EBlockingType::None)};
    bench.Order(order);
    bench.Status("paused", EActionStatus::Running);
    bench.Status("paused", EActionStatus::Paused);
    bench.Status("runs", EActionStatus::Running);
    bench.Mode(EOperatingMode::Manual);
    for (const ActionState& action : bench.GetSession().GetState().actionStates)
    {
        CHECK(action.actionStatus == EActionStatus::Failed);
        CHECK(action.resultDescription == "the operating mode changed");
    }
}

TEST_CASE("5.7 initPosition enables the only version of its map, but none of several versions")
{
    for (const bool bSeveral : {false, true})
    {
        VehicleSessionFixture bench(MakeCapable());
        std::vector<MapState> maps{{"roof", "1", EMapStatus::Disabled, {}}, {"floor", "1", EMapStatus::Enabled, {}}};
        if (bSeveral)
        {
            maps.push_back({"roof", "2", EMapStatus::Disabled, {}});
        }
        VehicleActions out;
        bench.GetSession().OnMaps(maps, bench.GetNow(), out);
        bench.Instant("initPosition", "i1", MakePose("roof"));
        bench.Status("i1", EActionStatus::Running);
        bench.Status("i1", EActionStatus::Finished);
        maps[0].mapStatus = bSeveral ? EMapStatus::Disabled : EMapStatus::Enabled;
        CHECK(bench.GetSession().GetState().maps == maps);
        CHECK(bench.GetSession().GetState().agvPosition->mapID == "roof");
    }
}

TEST_CASE("5.7 After initPosition the vehicle is on the given node, and sequenceIds stay those of its old order")
{
    VehicleSessionFixture bench(MakeCapable());
    OrderBuilder builder = MakeBuilder(2);
    Complete(bench, *builder.MakeOrder(2));
    bench.Instant("initPosition", "i1", MakePose("floor"));
    bench.Status("i1", EActionStatus::Running);
    bench.Status("i1", EActionStatus::Finished);
    CHECK(bench.GetPublishedState().lastNodeID == "N7");
    CHECK(bench.GetPublishedState().lastNodeSequenceID == 2);
    CHECK(bench.GetPublishedState().orderID == "order-1");
    CHECK_FALSE(bench.GetPublishedState().distanceSinceLastNode.has_value());
    // The old order ended at N1: an update from there would begin where the vehicle is not any more.
    REQUIRE(builder.Append({OrderNode{"N2", 0, {}, false, {}, {}}}, {OrderEdge{}}).has_value());
    OrderMessage update = *builder.MakeUpdate(3);
    update.edges[0].edgeID = "E1";
    bench.Order(update);
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    // A new order counts from 0 again, and upwards.
    OrderMessage next = MakeOrder(2, 2, "order-2");
    next.nodes[0].nodeID = "N7";
    next.nodes[0].nodePosition->x = 70.0;
    next.edges[0].startNodeID = "N7";
    bench.Order(next);
    CHECK(bench.GetPublishedState().lastNodeID == "N7");
    CHECK(bench.GetPublishedState().lastNodeSequenceID == 0);
    bench.Reach(2);
    CHECK(bench.GetPublishedState().lastNodeSequenceID == 2);
}

TEST_CASE("5.7 The result of an action is its resultDescription: the name of a logReport, also for an order's action")
{
    VehicleSessionFixture bench(MakeCapable());
    OrderMessage order = MakeOrder(1, 1);
    order.nodes[0].actions.push_back(MakeAction("find", EBlockingType::None, "detectObject"));
    bench.Order(order);
    bench.Instant("logReport", "log", {{"reason", Core::JsonText::FromString("test")}});
    VehicleActions out;
    for (const char* actionID : {"find", "log"})
    {
        bench.Status(actionID, EActionStatus::Running);
        CHECK(bench.GetSession().TrySetActionStatus(
            actionID,
            EActionStatus::Finished,
            "of " + std::string(actionID),
            bench.GetNow(),
            out));
    }
    const StateMessage state = bench.GetSession().GetState();
    REQUIRE(state.actionStates.size() == 2);
    CHECK(state.actionStates[0].resultDescription == "of find");
    CHECK(state.actionStates[1].resultDescription == "of log");
    CHECK(state.errors.empty());
    CheckPublished(out);
}

TEST_CASE("5.7 An instant action that fails after its start is a warning until another one is accepted")
{
    VehicleSessionFixture bench(MakeCapable());
    bench.Instant("startCharging", "charge");
    bench.Status("charge", EActionStatus::Running);
    VehicleActions out;
    CHECK(bench.GetSession().TrySetActionStatus("charge", EActionStatus::Failed, "not aligned", bench.GetNow(), out));
    CheckPublished(out);
    const StateMessage state = bench.GetSession().GetState();
    const VehicleError* error = FindErrorOrNull(state, ErrorTypes::ACTION_ERROR);
    REQUIRE(error != nullptr);
    CHECK(error->errorLevel == EErrorLevel::Warning);
    CHECK(error->errorDescription == "startCharging failed: not aligned");
    CHECK(*FindReferenceOrNull(*error, "topic") == "instantActions");
    CHECK(*FindReferenceOrNull(*error, "actionId") == "charge");
    CHECK(FindReferenceOrNull(*error, "headerId") == nullptr);
    bench.Instant("makeCoffee", "i1"); // none that is taken
    CHECK(FindErrorOrNull(bench.GetSession().GetState(), ErrorTypes::ACTION_ERROR) != nullptr);
    bench.Instant("stateRequest", "i2");
    CHECK(FindErrorOrNull(bench.GetSession().GetState(), ErrorTypes::ACTION_ERROR) == nullptr);
}

TEST_CASE("5.7 charging and loads are what the vehicle measures, not what an action should have changed")
{
    VehicleSessionFixture bench(MakeCapable());
    bench.Instant("startCharging", "charge");
    bench.Status("charge", EActionStatus::Running);
    bench.Status("charge", EActionStatus::Finished);
    CHECK_FALSE(bench.GetSession().GetState().batteryState.bCharging);
    BatteryState battery;
    battery.bCharging = true;
    VehicleActions out;
    bench.GetSession().OnBattery(battery, bench.GetNow(), out);
    CHECK(bench.GetSession().GetState().batteryState.bCharging);
    CHECK(Pick<PublishMessage>(out).size() == 1);
}

TEST_CASE("7 The allowed deviation from the first node is the node's own; absent or 0, the vehicle's")
{
    struct Case
    {
        std::optional<double> stated;
        double own;
        double distance;
        bool bTaken;
    };
    const std::vector<Case> cases{
        {std::nullopt, 0.5, 0.4, true},
        {std::nullopt, 0.5, 0.6, false},
        {std::nullopt, 1.0, 0.6, true},
        {0.0, 0.5, 0.4, true},
        {0.0, 0.5, 0.6, false},
        {0.1, 0.5, 0.4, false},
        {0.7, 0.5, 0.6, true},
    };
    for (const Case& deviation : cases)
    {
        CAPTURE(deviation.stated, deviation.own, deviation.distance);
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        options.defaultDeviationXY = deviation.own;
        VehicleSessionFixture bench(options);
        bench.StandAt(deviation.distance);
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[0].nodePosition->allowedDeviationXY = deviation.stated;
        bench.Order(order);
        CHECK(bench.HasError(ErrorTypes::NO_ROUTE_ERROR) != deviation.bTaken);
    }
}

TEST_CASE("12 An orderId that comes again after its order is done is an update or a repetition")
{
    VehicleSessionFixture bench;
    Complete(bench, MakeOrder(2, 2));
    bench.Order(MakeOrder(2, 2)); // the same once more: nothing is done twice
    CHECK(Pick<OrderTaken>(bench.GetOutput()).empty());
    CHECK(bench.GetPublishedState().errors.empty());
    OrderMessage again = MakeOrder(2, 2);
    again.orderUpdateID = 1;
    bench.Order(again);
    CHECK(bench.HasError(ErrorTypes::ORDER_UPDATE_ERROR));
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
}

TEST_CASE("12 An order that comes sooner than minOrderInterval is accepted: the interval binds the master")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolLimits.timing.minOrderInterval = 10.0;
    VehicleSessionFixture bench(options);
    OrderBuilder builder = MakeBuilder(3);
    bench.Order(*builder.MakeOrder(2));
    bench.Order(*builder.MakeUpdate(3));
    CHECK(bench.GetPublishedState().orderUpdateID == 1);
    CHECK(bench.GetPublishedState().errors.empty());
}

} // namespace ACS::VDA5050::Test

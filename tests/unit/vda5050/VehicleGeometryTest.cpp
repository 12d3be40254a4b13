#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

namespace ACS::VDA5050::Test
{

namespace
{

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

/// From N0 to N1 in a straight line.
Trajectory MakeLine()
{
    return Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{0.0, 0.0, {}}, ControlPoint{10.0, 0.0, {}}}};
}

OrderMessage MakeCurved(std::size_t nodes, std::size_t released)
{
    OrderMessage order = MakeOrder(nodes, released);
    order.edges[0].trajectory = MakeLine();
    return order;
}

/// Two nodes; the edge has a corridor. The order goes in as 2.1 writes it.
void OrderWithCorridor(VehicleSessionFixture& bench, std::size_t nodes = 2, std::vector<Action> actions = {})
{
    OrderMessage order = MakeOrder(nodes, nodes);
    order.nodes[0].actions = std::move(actions);
    order.edges[0].corridor = Corridor{1.0, 1.0, {}};
    order.header = Header{0, bench.GetNow().wall, "2.1.0", "ACS", "LR01"};
    bench.Payload(ETopic::Order, Vda5050Codec().Encode(order, EVda5050Version::Version210));
    REQUIRE(bench.GetSession().GetState().orderID == "order-1");
}

bool TryCorridor(VehicleSessionFixture& bench, bool bOutside, VehicleActions& out)
{
    out.clear();
    return bench.GetSession().TrySetOutsideCorridor(bOutside, bench.GetNow(), out);
}

bool IsOutside(const VehicleSessionFixture& bench)
{
    return std::ranges::count(
               bench.GetPublishedState().errors,
               ErrorTypes::OUTSIDE_OF_CORRIDOR,
               &VehicleError::errorType)
        > 0;
}

} // namespace

TEST_CASE("7 An invalid NURBS is reported as a validationError")
{
    struct Case
    {
        const char* name;
        std::function<void(Trajectory&)> change;
        bool bRight;
    };
    const std::vector<Case> cases{
        {"a line", [](Trajectory&) {}, true},
        {"degree 0",
         [](Trajectory& curve) {
             curve = Trajectory{0, {0.0, 0.5, 1.0}, curve.controlPoints};
         },
         false},
        {"fewer points than the degree needs",
         [](Trajectory& curve) {
             curve = Trajectory{2, {0.0, 0.0, 0.5, 1.0, 1.0}, curve.controlPoints};
         },
         false},
        {"a knot too many", [](Trajectory& curve) { curve.knotVector.push_back(1.0); }, false},
        {"a knot below 0", [](Trajectory& curve) { curve.knotVector[0] = -0.1; }, false},
        {"knots that fall",
         [](Trajectory& curve) {
             curve.knotVector = {0.0, 0.6, 0.4, 1.0};
         },
         false},
        {"a knot that is no number", [](Trajectory& curve) { curve.knotVector[1] = NOT_A_NUMBER; }, false},
        {"a point that is no number", [](Trajectory& curve) { curve.controlPoints[1].y = NOT_A_NUMBER; }, false},
        {"a weight", [](Trajectory& curve) { curve.controlPoints[0].weight = 3.0; }, true},
        {"a negative weight", [](Trajectory& curve) { curve.controlPoints[0].weight = -1.0; }, false},
        {"a weight that is no number", [](Trajectory& curve) { curve.controlPoints[0].weight = NOT_A_NUMBER; }, false},
        {"a negative weight inside",
         [](Trajectory& curve) {
             curve.knotVector = {0.0, 0.0, 0.5, 1.0, 1.0};
             curve.controlPoints.insert(curve.controlPoints.begin() + 1, ControlPoint{5.0, 0.0, -0.5});
         },
         false},
        {"a begin without weight", [](Trajectory& curve) { curve.controlPoints[0].weight = 0.0; }, false},
        {"an end without weight", [](Trajectory& curve) { curve.controlPoints[1].weight = 0.0; }, false},
        {"an inner point without weight",
         [](Trajectory& curve) {
             curve.knotVector = {0.0, 0.0, 0.5, 1.0, 1.0};
             curve.controlPoints.insert(curve.controlPoints.begin() + 1, ControlPoint{5.0, 0.0, 0.0});
         },
         true},
        {"two in turn without weight, which degree 1 needs",
         [](Trajectory& curve) {
             curve.knotVector = {0.0, 0.0, 0.3, 0.6, 1.0, 1.0};
             curve.controlPoints.insert(curve.controlPoints.begin() + 1, 2, ControlPoint{5.0, 0.0, 0.0});
         },
         false},
    };
    for (const Case& curve : cases)
    {
        CAPTURE(curve.name);
        OrderMessage order = MakeCurved(2, 2);
        curve.change(*order.edges[0].trajectory);
        const std::vector<OrderViolation> violations = ValidateOrder(order);
        REQUIRE(violations.empty() == curve.bRight);
        if (!curve.bRight)
        {
            CHECK(violations[0].error.errorType == ErrorTypes::VALIDATION_ERROR);
            CHECK(*FindReferenceOrNull(violations[0].error, "edgeId") == "E0");
        }
    }
}

TEST_CASE("4.1 Heights that are not numbers are reported")
{
    for (std::optional<double> OrderEdge::*const member : {&OrderEdge::maxHeight, &OrderEdge::minHeight})
    {
        OrderMessage order = MakeOrder(2, 2);
        order.edges[0].*member = 2.0;
        CHECK(ValidateOrder(order).empty());
        order.edges[0].*member = NOT_A_NUMBER;
        CHECK(ValidateOrder(order).size() == 1);
    }
}

TEST_CASE("7 A trajectory that does not begin and end at its nodes is refused with orderError")
{
    struct Case
    {
        const char* name;
        std::function<void(OrderMessage&)> change;
        const char* nodeID; ///< Empty: taken.
    };
    const std::vector<Case> cases{
        {"from node to node", [](OrderMessage&) {}, ""},
        {"begins beside its node",
         [](OrderMessage& order) { order.edges[0].trajectory->controlPoints[0].y = 0.6; },
         "N0"},
        {"ends beside its node",
         [](OrderMessage& order) { order.edges[0].trajectory->controlPoints[1].y = 0.6; },
         "N1"},
        {"ends within the vehicle's own deviation",
         [](OrderMessage& order) { order.edges[0].trajectory->controlPoints[1].y = 0.4; },
         ""},
        {"ends within the deviation that its node states",
         [](OrderMessage& order) {
             order.edges[0].trajectory->controlPoints[1].y = 2.0;
             order.nodes[1].nodePosition->allowedDeviationXY = 2.5;
         },
         ""},
        {"ends beyond the deviation that its node states",
         [](OrderMessage& order) {
             order.edges[0].trajectory->controlPoints[1].y = 0.2;
             order.nodes[1].nodePosition->allowedDeviationXY = 0.1;
         },
         "N1"},
        {"ends at a node without a position",
         [](OrderMessage& order) {
             order.edges[0].trajectory->controlPoints[1].y = 99.0;
             order.nodes[1].nodePosition.reset();
         },
         ""},
        {"is not clamped, and leads from node to node",
         [](OrderMessage& order) {
             order.edges[0].trajectory =
                 Trajectory{2, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}, {{-5.0, 0.0, {}}, {5.0, 0.0, {}}, {15.0, 0.0, {}}}};
         },
         ""},
        {"is not clamped, and begins beside its node, unlike the control points",
         [](OrderMessage& order) {
             order.edges[0].trajectory =
                 Trajectory{2, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}, {{0.0, 0.0, {}}, {5.0, 0.0, {}}, {15.0, 0.0, {}}}};
         },
         "N0"},
        {"in the horizon",
         [](OrderMessage& order) {
             order.edges[1].trajectory = MakeLine();
             order.edges[1].trajectory->controlPoints[0].x = 10.0;
         },
         "N2"},
    };
    for (const Case& curve : cases)
    {
        CAPTURE(curve.name);
        VehicleSessionFixture bench;
        OrderMessage order = MakeCurved(3, 2);
        curve.change(order);
        bench.Order(order);
        const StateMessage state = bench.GetPublishedState();
        const std::string nodeID = curve.nodeID;
        CHECK(state.orderID == (nodeID.empty() ? "order-1" : ""));
        REQUIRE(state.errors.size() == (nodeID.empty() ? 0 : 1));
        if (!nodeID.empty())
        {
            CHECK(state.errors[0].errorType == ErrorTypes::ORDER_ERROR);
            CHECK(state.errors[0].errorLevel == EErrorLevel::Warning);
            CHECK(*FindReferenceOrNull(state.errors[0], "nodeId") == nodeID);
            CHECK(*FindReferenceOrNull(state.errors[0], "edgeId") == (nodeID == "N2" ? "E1" : "E0"));
            CHECK(*FindReferenceOrNull(state.errors[0], "parameter") == "order.edges.trajectory");
        }
    }
}

TEST_CASE("3.4 An order for a zone set that the vehicle does not have is rejected; one without a zone set is accepted")
{
    struct Case
    {
        const char* zoneSetID;
        bool bTaken;
    };
    for (const Case& order : std::vector<Case>{{"", true}, {"day", true}, {"night", false}})
    {
        CAPTURE(order.zoneSetID);
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        options.zoneSetIDs = {"day"};
        VehicleSessionFixture bench(options);
        OrderMessage message = MakeOrder(2, 2);
        message.zoneSetID = order.zoneSetID;
        bench.Order(message);
        CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) != order.bTaken);
        if (!order.bTaken)
        {
            CHECK(*FindReferenceOrNull(bench.GetPublishedState().errors.at(0), "parameter") == "order.zoneSetId");
        }
        CHECK(bench.GetPublishedState().zoneSetID == (order.bTaken ? order.zoneSetID : ""));
    }
    VehicleSessionFixture any;
    OrderMessage message = MakeOrder(2, 2);
    message.zoneSetID = "night";
    any.Order(message);
    CHECK(any.GetPublishedState().zoneSetID == "night");
}

TEST_CASE("7 Outside its corridor the vehicle stops and reports an error until it is back inside")
{
    VehicleSessionFixture bench;
    OrderWithCorridor(bench);
    bench.Drive(true);
    VehicleActions out;
    CHECK(TryCorridor(bench, false, out));
    CHECK(out.empty());
    bench.Clear();
    CHECK(TryCorridor(bench, true, out));
    CHECK(Pick<StopDriving>(out).size() == 1);
    CHECK(Pick<PublishMessage>(out).size() == 1);
    CheckPublished(out);
    const StateMessage state = bench.GetSession().GetState();
    REQUIRE(state.errors.size() == 1);
    CHECK(state.errors[0].errorType == ErrorTypes::OUTSIDE_OF_CORRIDOR);
    CHECK(state.errors[0].errorLevel == EErrorLevel::Fatal);
    CHECK(*FindReferenceOrNull(state.errors[0], "edgeId") == "E0");
    CHECK(*FindReferenceOrNull(state.errors[0], "topic") == "order");
    CHECK(FindReferenceOrNull(state.errors[0], "orderId") == nullptr);
    CHECK(TryCorridor(bench, true, out));
    CHECK(out.empty()); // reported already
    bench.Drive(false);
    bench.Instant("startPause", "p1");
    bench.Instant("stopPause", "p2");
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    CHECK(IsOutside(bench));
    CHECK(TryCorridor(bench, false, out));
    CHECK(Pick<DriveTo>(out).size() == 1);
    CHECK(bench.GetSession().GetState().errors.empty());
}

TEST_CASE("7 The error about a corridor ends with its edge or with a cancel and is not reported for another edge")
{
    VehicleActions out;
    VehicleSessionFixture none;
    CHECK_FALSE(TryCorridor(none, true, out));
    none.Order(MakeOrder(2, 2));
    CHECK_FALSE(TryCorridor(none, true, out));
    CHECK(none.GetSession().GetState().errors.empty());

    VehicleSessionFixture waiting; // at the node before the edge
    OrderWithCorridor(waiting, 2, {MakeAction("a1", EBlockingType::Hard)});
    CHECK_FALSE(TryCorridor(waiting, true, out));

    VehicleSessionFixture reached;
    OrderWithCorridor(reached, 3);
    CHECK(TryCorridor(reached, true, out));
    reached.Reach(2); // while it brakes
    CHECK_FALSE(IsOutside(reached));
    CHECK(Pick<DriveTo>(reached.GetOutput()).back().node.nodeID == "N2");

    VehicleSessionFixture cancelled;
    OrderWithCorridor(cancelled);
    CHECK(TryCorridor(cancelled, true, out));
    cancelled.Instant("cancelOrder", "c1");
    CHECK(IsOutside(cancelled));
    cancelled.Drive(false);
    CHECK(cancelled.GetStatus("c1") == EActionStatus::Finished);
    CHECK_FALSE(IsOutside(cancelled));
}

TEST_CASE("7 A vehicle that stops only on nodes and is outside its corridor ends a cancel where it is stationary")
{
    for (const bool bCancelFirst : {false, true})
    {
        CAPTURE(bCancelFirst);
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        options.bStopsBetweenNodes = false;
        VehicleSessionFixture bench(options);
        OrderWithCorridor(bench);
        bench.Drive(true);
        VehicleActions out;
        if (bCancelFirst)
        {
            bench.Instant("cancelOrder", "c1");
            CHECK(TryCorridor(bench, true, out));
        }
        else
        {
            CHECK(TryCorridor(bench, true, out));
            bench.Instant("cancelOrder", "c1");
        }
        CHECK(Pick<StopDriving>(out).size() == 1);
        CHECK(bench.GetStatus("c1") == EActionStatus::Running);
        bench.Drive(false);
        CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
        CHECK(bench.GetSession().GetState().nodeStates.empty());
    }
}

TEST_CASE("7 A cancelled vehicle that is moved out of its corridor while paused ends its cancel")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.bStopsBetweenNodes = false;
    VehicleSessionFixture bench(options);
    OrderWithCorridor(bench);
    bench.Drive(true);
    bench.Instant("startPause", "p1");
    bench.Drive(false);
    bench.Instant("cancelOrder", "c1");
    CHECK(bench.GetStatus("c1") == EActionStatus::Running);
    VehicleActions out;
    CHECK(TryCorridor(bench, true, out));
    CHECK(bench.GetStatus("c1") == EActionStatus::Finished);
    CHECK_FALSE(IsOutside(bench));
}

TEST_CASE("4.4 A vehicle that plans its own trajectory publishes it in edgeStates and does not change it")
{
    VehicleSessionFixture bench;
    OrderMessage order = MakeCurved(3, 3);
    bench.Order(order);
    bench.Clear();
    VehicleActions out;
    const auto trySet = [&bench, &out](std::uint32_t sequenceID, const Trajectory& trajectory) {
        out.clear();
        return bench.GetSession().TrySetTrajectory(sequenceID, trajectory, bench.GetNow(), out);
    };
    Trajectory planned = MakeLine();
    planned.controlPoints[1].y = 3.0;
    CHECK_FALSE(trySet(1, planned)); // the order defines the trajectory
    CHECK_FALSE(trySet(5, planned)); // no such edge
    CHECK_FALSE(trySet(3, Trajectory{1, {0.0}, {}}));
    CHECK(trySet(3, planned));
    CheckPublished(out);
    CHECK(Pick<PublishMessage>(out).size() == 1);
    CHECK(bench.GetSession().GetState().edgeStates[0].trajectory == MakeLine());
    CHECK(bench.GetSession().GetState().edgeStates[1].trajectory == planned);
    CHECK_FALSE(trySet(3, MakeLine()));
    CHECK(bench.GetSession().GetState().edgeStates[1].trajectory == planned);
}

TEST_CASE("7 A trajectory of a degree above the limit of the library is refused with orderError")
{
    for (const std::uint32_t degree : {MAXIMUM_CURVE_DEGREE, MAXIMUM_CURVE_DEGREE + 1})
    {
        CAPTURE(degree);
        OrderMessage order = MakeOrder(2, 2);
        Trajectory& curve = order.edges[0].trajectory.emplace();
        curve.degree = degree;
        for (std::uint32_t index = 0; index <= degree; ++index)
        {
            curve.controlPoints.push_back(ControlPoint{10.0 * index / degree, 0.0, {}});
        }
        curve.knotVector.assign(degree + 1, 0.0);
        curve.knotVector.insert(curve.knotVector.end(), degree + 1, 1.0);
        REQUIRE(ValidateOrder(order).empty());
        VehicleSessionFixture bench;
        bench.Order(order);
        const bool bRefused = degree > MAXIMUM_CURVE_DEGREE;
        const StateMessage state = bench.GetPublishedState();
        CHECK(state.orderID == (bRefused ? "" : "order-1"));
        REQUIRE(state.errors.size() == (bRefused ? 1 : 0));
        if (bRefused)
        {
            CHECK(state.errors[0].errorType == ErrorTypes::ORDER_ERROR);
            CHECK(*FindReferenceOrNull(state.errors[0], "parameter") == "order.edges.trajectory");
            CHECK(*FindReferenceOrNull(state.errors[0], "edgeId") == "E0");
        }
    }
}

TEST_CASE("7 The ends of trajectories are not checked in an order that the vehicle cannot drive for other reasons")
{
    OrderMessage order = MakeCurved(2, 2);
    order.edges[0].trajectory->controlPoints[1].y = 0.6;
    order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, "makeCoffee"));
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    VehicleSessionFixture bench(options);
    bench.Order(order);
    const StateMessage state = bench.GetPublishedState();
    REQUIRE(state.errors.size() == 1);
    CHECK(*FindReferenceOrNull(state.errors[0], "actionId") == "a1");
}

} // namespace ACS::VDA5050::Test

#include "Catch.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/OrderValidator.hpp>

#include <functional>
#include <limits>

namespace ACS::VDA5050::Test
{

TEST_CASE("4.1 Each violated rule of an order's structure is reported separately")
{
    struct Case
    {
        const char* name;
        std::function<void(OrderMessage&)> spoil;
    };
    const std::vector<Case> cases{
        {"no node",
         [](OrderMessage& order) {
             order.nodes.clear();
         }},
        {"an edge too many",
         [](OrderMessage& order) {
             order.edges.push_back(order.edges.back());
         }},
        {"no orderId",
         [](OrderMessage& order) {
             order.orderID.clear();
         }},
        {"odd node",
         [](OrderMessage& order) {
             order.nodes[0].sequenceID = 1;
         }},
        {"gap",
         [](OrderMessage& order) {
             order.nodes[2].sequenceID = 6;
         }},
        {"edge out of sequence",
         [](OrderMessage& order) {
             order.edges[1].sequenceID = 5;
         }},
        {"first node unreleased",
         [](OrderMessage& order) {
             order.nodes[0].bReleased = false;
         }},
        {"released behind the horizon",
         [](OrderMessage& order) {
             order.nodes[3].bReleased = true;
         }},
        {"released edge into the horizon",
         [](OrderMessage& order) {
             order.edges[2].bReleased = true;
         }},
        {"wrong neighbour",
         [](OrderMessage& order) {
             order.edges[0].endNodeID = "N9";
         }},
        {"action without id",
         [](OrderMessage& order) {
             order.nodes[1].actions.push_back(MakeAction("", EBlockingType::None));
         }},
        {"repeated actionId",
         [](OrderMessage& order) {
             order.nodes[1].actions.push_back(MakeAction("a", EBlockingType::None));
             order.edges[1].actions.push_back(MakeAction("a", EBlockingType::None));
         }},
        {"null parameter",
         [](OrderMessage& order) {
             order.nodes[1].actions.push_back(MakeAction("a", EBlockingType::None));
             order.nodes[1].actions[0].actionParameters.push_back(ActionParameter{"key", {}});
         }},
        {"node without id",
         [](OrderMessage& order) {
             order.nodes[2].nodeID.clear();
             order.edges[1].endNodeID.clear();
             order.edges[2].startNodeID.clear();
         }},
        {"edge without id",
         [](OrderMessage& order) {
             order.edges[2].edgeID.clear();
         }},
        {"a position that is no number",
         [](OrderMessage& order) {
             order.nodes[1].nodePosition->x = std::numeric_limits<double>::quiet_NaN();
         }},
        {"theta beyond pi",
         [](OrderMessage& order) {
             order.nodes[1].nodePosition->theta = -3.2;
         }},
        {"negative deviation",
         [](OrderMessage& order) {
             order.nodes[1].nodePosition->allowedDeviationXY = -0.1;
         }},
        {"negative angle of deviation",
         [](OrderMessage& order) {
             order.nodes[1].nodePosition->allowedDeviationTheta = -0.1;
         }},
        {"orientation beyond pi",
         [](OrderMessage& order) {
             order.edges[1].orientation = 3.2;
         }},
        {"negative speed",
         [](OrderMessage& order) {
             order.edges[1].maxSpeed = -1.0;
         }},
        {"negative rotation speed",
         [](OrderMessage& order) {
             order.edges[1].maxRotationSpeed = -1.0;
         }},
        {"negative length",
         [](OrderMessage& order) {
             order.edges[1].length = -1.0;
         }},
        {"negative corridor",
         [](OrderMessage& order) {
             order.edges[1].corridor = Corridor{1.0, -1.0, {}};
         }},
        {"knots beyond 1",
         [](OrderMessage& order) {
             order.edges[0].trajectory = Trajectory{1, {0.0, 0.0, 1.0, 1.5}, {ControlPoint{}, ControlPoint{}}};
         }},
        {"falling knots",
         [](OrderMessage& order) {
             order.edges[0].trajectory = Trajectory{1, {0.0, 1.0, 0.5, 1.0}, {ControlPoint{}, ControlPoint{}}};
         }},
        {"too few knots",
         [](OrderMessage& order) {
             order.edges[0].trajectory = Trajectory{1, {0.0, 1.0}, {ControlPoint{}, ControlPoint{}}};
         }},
    };
    CHECK(ValidateOrder(MakeOrder(4, 3)).empty());
    for (const Case& spoiled : cases)
    {
        CAPTURE(spoiled.name);
        OrderMessage order = MakeOrder(4, 3);
        spoiled.spoil(order);
        const std::vector<OrderViolation> violations = ValidateOrder(order);
        REQUIRE_FALSE(violations.empty());
        CHECK(violations[0].error.errorType == ErrorTypes::VALIDATION_ERROR);
        CHECK(violations[0].error.errorLevel == EErrorLevel::Warning);
        CHECK(FindReferenceOrNull(violations[0].error, "topic") != nullptr);
    }
}

TEST_CASE("7 A straight trajectory of degree 1 keeps the rules of a NURBS")
{
    OrderMessage order = MakeOrder(2, 2);
    order.edges[0].trajectory = Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{10.0, 0.0, {}}}};
    CHECK(ValidateOrder(order).empty());
}

TEST_CASE("4.2 Orders are refused outside of automatic modes, without a position, and on an unknown map")
{
    const OrderMessage order = MakeOrder(2, 2);
    OrderContext context;
    context.lastNodeID = "N0";
    CHECK(JudgeOrder(order, context).verdict == EOrderVerdict::NewOrder);
    context.operatingMode = EOperatingMode::Service;
    CHECK(JudgeOrder(order, context).violations.at(0).error.errorType == ErrorTypes::ORDER_ERROR);
    context.operatingMode = EOperatingMode::SemiAutomatic;
    context.mapIDs = {"other"};
    CHECK(JudgeOrder(order, context).violations.at(0).error.errorType == ErrorTypes::ORDER_ERROR);
    context.mapIDs = {"floor"};
    context.position = AgvPosition{};
    context.position->mapID = "floor";
    CHECK(JudgeOrder(order, context).violations.at(0).error.errorType == ErrorTypes::NO_ROUTE_ERROR);
    context.position->bPositionInitialized = true;
    CHECK(JudgeOrder(order, context).verdict == EOrderVerdict::NewOrder);
}

} // namespace ACS::VDA5050::Test

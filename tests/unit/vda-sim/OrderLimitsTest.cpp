#include "vda-sim/OrderLimits.hpp"

#include "Catch.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include "VehicleDriver.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::OrderMessage;

/// A straight curve from N0 to N1 of this degree with this number of control points.
VDA5050::Trajectory MakeCurve(std::uint32_t degree, std::uint32_t points)
{
    VDA5050::Trajectory curve;
    curve.degree = degree;
    for (std::uint32_t i = 0; i < points; ++i)
    {
        curve.controlPoints.push_back({10.0 * i / (points - 1), 0.0, {}});
    }
    const std::uint32_t inner = points - degree - 1;
    curve.knotVector.assign(degree + 1, 0.0);
    for (std::uint32_t i = 1; i <= inner; ++i)
    {
        curve.knotVector.push_back(static_cast<double>(i) / (inner + 1));
    }
    curve.knotVector.insert(curve.knotVector.end(), degree + 1, 1.0);
    return curve;
}

struct Row
{
    std::string_view errorType;
    std::string_view referenceKey;
    std::string_view referenceValue;
    std::function<void(OrderMessage&)> change;
};

OrderMessage MakeOrder(VehicleDriver& driver, const std::string& orderID = "order-1")
{
    auto route = driver.MakeRoute(orderID, {"N0", "N1", "N2"});
    return VehicleDriver::Take(route.MakeOrder(3));
}

} // namespace

TEST_CASE("6.6 An order that the vehicle could not drive to its end is refused, with the node or edge that is why")
{
    const std::string_view order = VDA5050::ErrorTypes::ORDER_ERROR;
    const std::string_view route = VDA5050::ErrorTypes::NO_ROUTE_ERROR;
    const std::vector<Row> rows{
        {order,
         "edgeId",
         "N1-N2",
         [](OrderMessage& message) {
             message.edges[1].maxSpeed = 0.0;
         }},
        {order,
         "edgeId",
         "N0-N1",
         [](OrderMessage& message) {
             message.edges[0].maxSpeed = VdaSim::MIN_SPEED / 2;
         }},
        {order,
         "parameter",
         "order.edges.maxSpeed",
         [](OrderMessage& message) {
             message.edges[0].maxSpeed = 1e-9;
         }},
        {order,
         "parameter",
         "order.edges.maxRotationSpeed",
         [](OrderMessage& message) {
             message.edges[0].maxRotationSpeed = 0.0;
             message.edges[0].bRotationAllowed = false;
         }},
        {route,
         "nodeId",
         "N2",
         [](OrderMessage& message) {
             message.nodes[2].nodePosition->x = 1e300;
         }},
        {route,
         "nodeId",
         "N1",
         [](OrderMessage& message) {
             message.nodes[1].nodePosition->y = -20'000.0;
         }},
        {route,
         "nodeId",
         "ghost",
         [](OrderMessage& message) {
             message.nodes[1].nodeID = "ghost";
             message.nodes[1].nodePosition.reset();
             message.edges[0].endNodeID = "ghost";
             message.edges[1].startNodeID = "ghost";
         }},
        {order,
         "parameter",
         "order.edges.trajectory",
         [](OrderMessage& message) {
             message.edges[0].trajectory = MakeCurve(VdaSim::MAX_DEGREE + 1, 20);
         }},
        {order,
         "edgeId",
         "N0-N1",
         [](OrderMessage& message) {
             message.edges[0].trajectory = MakeCurve(2, 3);
             message.edges[0].trajectory->controlPoints[1].y = 1e300;
         }},
        {order, "parameter", "maxArrayLens.trajectory.controlPoints", [](OrderMessage& message) {
             message.edges[0].trajectory = MakeCurve(2, VdaSim::MAX_CONTROL_POINTS + 1);
         }}};
    for (const Row& row : rows)
    {
        CAPTURE(row.referenceKey, row.referenceValue);
        VehicleDriver driver("N0");
        OrderMessage message = MakeOrder(driver);
        row.change(message);
        driver.Send(message);
        driver.Pass(5s);
        CHECK(driver.GetState().orderID.empty());
        CHECK(driver.GetPose() == VdaSim::Pose{});
        REQUIRE(driver.GetState().errors.size() == 1);
        CHECK(driver.GetState().errors[0].errorType == row.errorType);
        CHECK(HasReference(driver.GetState().errors[0], row.referenceKey, row.referenceValue));
        driver.Send(MakeOrder(driver, "order-2"));
        CHECK(driver.GetState().bDriving);
    }
}

TEST_CASE("6.6 The slowest, most bent and farthest order that is allowed is driven; a known node needs no position")
{
    VehicleDriver driver("N0");
    OrderMessage order = MakeOrder(driver);
    order.edges[0].maxSpeed = VdaSim::MIN_SPEED;
    order.edges[0].maxRotationSpeed = VdaSim::MIN_TURN_SPEED;
    order.edges[0].trajectory = MakeCurve(VdaSim::MAX_DEGREE, VdaSim::MAX_CONTROL_POINTS);
    order.nodes[1].nodePosition.reset();
    order.nodes[2].nodePosition->y = VdaSim::MAX_REACH - 1.0;
    driver.Send(order);
    driver.Pass(10s);
    CHECK(driver.GetState().errors.empty());
    CHECK(driver.GetPose().x == Approx(0.1).margin(0.01));
}

TEST_CASE("6.6 Of a hundred broken rules of an order the first sixteen are reported")
{
    VehicleDriver driver("N0");
    auto route = driver.MakeRoute("order-1", {"N0", "N1"});
    OrderMessage order = VehicleDriver::Take(route.MakeOrder(2));
    for (std::uint32_t i = 0; i < 100; ++i)
    {
        order.edges.push_back(order.edges.back());
        order.nodes.push_back(order.nodes.back());
        order.edges.back().maxSpeed = 0.0;
    }
    const Planning::SiteMap site = MakeTestSite();
    CHECK(VdaSim::FindUndrivable(order, site).size() == 16);
}

TEST_CASE("6.8 initPosition beyond all reach of the site fails, and the vehicle stays where it was")
{
    VehicleDriver driver("N0");
    driver.SendInstantly(
        VDA5050::ActionTypes::INIT_POSITION,
        "away",
        {{"x", Core::JsonText::FromNumber(1e300)},
         {"y", Core::JsonText::FromNumber(0.0)},
         {"theta", Core::JsonText::FromNumber(0.0)},
         {"mapId", Core::JsonText::FromString("floor")},
         {"lastNodeId", Core::JsonText::FromString("N0")}});
    CHECK(driver.GetStatus("away") == VDA5050::EActionStatus::Failed);
    CHECK(driver.GetPose() == VdaSim::Pose{});
}

TEST_CASE("6.8 initPosition with a lastNodeId that the site does not have fails; an empty one does not")
{
    VehicleDriver driver("N0");
    const auto place = [&driver](const std::string& actionID, std::string_view nodeID) {
        driver.SendInstantly(
            VDA5050::ActionTypes::INIT_POSITION,
            actionID,
            {{"x", Core::JsonText::FromNumber(4.5)},
             {"y", Core::JsonText::FromNumber(0.0)},
             {"theta", Core::JsonText::FromNumber(0.0)},
             {"mapId", Core::JsonText::FromString("floor")},
             {"lastNodeId", Core::JsonText::FromString(nodeID)}});
        driver.Pass(std::chrono::seconds(2));
        return driver.GetStatus(actionID);
    };
    CHECK(place("unknown", "NO-SUCH-NODE") == VDA5050::EActionStatus::Failed);
    CHECK(driver.GetPose() == VdaSim::Pose{});
    CHECK(driver.GetState().lastNodeID == "N0");
    CHECK(place("between", "N1") == VDA5050::EActionStatus::Finished);
    CHECK(driver.GetPose().x == 4.5);
    CHECK(place("none", "") == VDA5050::EActionStatus::Finished);
    CHECK(driver.GetState().lastNodeID.empty());
}

} // namespace ACS::Testing

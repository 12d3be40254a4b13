#include "RemainingRoute.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <string>
#include <vector>

namespace ACS::VDA5050
{
namespace
{

/// An edge with every member.
OrderEdge MakeFullEdge()
{
    OrderEdge edge;
    edge.edgeID = "E0";
    edge.sequenceID = 1;
    edge.edgeDescription = "through the gate";
    edge.bReleased = true;
    edge.startNodeID = "N0";
    edge.endNodeID = "N1";
    edge.maxSpeed = 1.25;
    edge.maxHeight = 2.5;
    edge.minHeight = 0.25;
    edge.orientation = 0.5;
    edge.orientationType = EOrientationType::Global;
    edge.direction = "left";
    edge.bRotationAllowed = false;
    edge.maxRotationSpeed = 0.75;
    edge.length = 3.5;
    edge.trajectory = Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {{0.0, 0.0, 1.0}, {3.5, 0.0, {}}}};
    edge.corridor = Corridor{0.5, 0.25, ECorridorReferencePoint::Contour};
    edge.actions.push_back(Test::MakeAction("on-edge", EBlockingType::None));
    return edge;
}

OrderNode MakeFullNode(const std::string& nodeID, std::uint32_t sequenceID)
{
    OrderNode node;
    node.nodeID = nodeID;
    node.sequenceID = sequenceID;
    node.nodeDescription = "behind the gate";
    node.bReleased = true;
    node.nodePosition = NodePosition{1.0, 2.0, 0.5, 0.25, 0.125, "hall", "the hall in the north"};
    node.actions.push_back(Test::MakeAction("on-" + nodeID, EBlockingType::Hard));
    return node;
}

OrderMessage MakeFullOrder()
{
    OrderMessage order;
    OrderEdge plain;
    plain.edgeID = "E1";
    plain.sequenceID = 3;
    plain.startNodeID = "N1";
    plain.endNodeID = "N2";
    OrderNode bare;
    bare.nodeID = "N2";
    bare.sequenceID = 4;
    order.nodes = {MakeFullNode("N0", 0), MakeFullNode("N1", 2), bare};
    order.edges = {MakeFullEdge(), plain};
    return order;
}

} // namespace

TEST_CASE("A remaining route returns every member of its edges and nodes, absent ones included")
{
    const OrderMessage order = MakeFullOrder();
    RemainingRoute route;
    route.Append(order);
    REQUIRE(route.GetSize() == 2);
    CHECK(route.CountReleased() == 1);
    for (std::size_t index = 0; index < 2; ++index)
    {
        CHECK(route.GetEdge(index) == order.edges[index]);
        CHECK(route.GetNode(index) == order.nodes[index + 1]);
        CHECK(route.GetNodeID(index) == order.nodes[index + 1].nodeID);
        CHECK(route.GetNodeSequenceID(index) == order.nodes[index + 1].sequenceID);
        CHECK(route.GetEdgeSequenceID(index) == order.edges[index].sequenceID);
        CHECK(route.GetNodeActions(index).size() == order.nodes[index + 1].actions.size());
        CHECK(route.GetEdgeActions(index).size() == order.edges[index].actions.size());
    }
    CHECK(
        route.GetNodeState(0) == NodeState{"N1", 2, "behind the gate", true, NodeStatePosition{1.0, 2.0, 0.5, "hall"}});
    CHECK(route.GetNodeState(1) == NodeState{"N2", 4, {}, false, {}});
    CHECK(route.GetEdgeState(0) == EdgeState{"E0", 1, "through the gate", true, order.edges[0].trajectory});
    CHECK(route.GetEdgeState(1) == EdgeState{"E1", 3, {}, false, {}});
}

TEST_CASE("A remaining route drops from its front and its end, and knows where its first edge begins")
{
    const OrderMessage order = MakeFullOrder();
    RemainingRoute route;
    route.Append(order);
    route.DropFrontActions();
    CHECK(route.GetNodeActions(0).empty());
    CHECK(route.GetEdgeActions(0).size() == 1);
    route.DropFront();
    CHECK(route.GetSize() == 1);
    CHECK(route.GetEdge(0) == order.edges[1]);
    CHECK(route.CountReleased() == 0);
    CHECK(route.GetReleasedBytes() == 0);
    route.Cut(0);
    CHECK(route.IsEmpty());
    CHECK(route.GetReleasedBytes() == 0);
    route.Append(order);
    route.Cut(1);
    CHECK(route.GetEdge(0) == order.edges[0]);
    route.Clear();
    CHECK(route.IsEmpty());
}

} // namespace ACS::VDA5050

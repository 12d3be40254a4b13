#include "AcceptedRoute.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// The nodes that a state on the given node of MakeOrder reports, with those after it left to reach.
std::vector<std::string> ReportReached(AcceptedRoute& route, const OrderMessage& order, std::size_t lastNode)
{
    StateMessage state;
    state.lastNodeID = order.nodes.at(lastNode).nodeID;
    state.lastNodeSequenceID = order.nodes.at(lastNode).sequenceID;
    for (std::size_t index = lastNode + 1; index < order.nodes.size(); ++index)
    {
        state.nodeStates.emplace_back().sequenceID = order.nodes[index].sequenceID;
    }
    MasterActions out;
    route.ReportReached(state, out);
    std::vector<std::string> nodeIDs;
    for (const NodeReached& reached : Pick<NodeReached>(out))
    {
        nodeIDs.push_back(reached.nodeID);
    }
    return nodeIDs;
}

} // namespace

TEST_CASE("6.7 Each node is reported once and in order, even if states were lost")
{
    const OrderMessage order = MakeOrder(4, 4);
    AcceptedRoute route;
    route.Extend(order);
    CHECK(ReportReached(route, order, 0) == std::vector<std::string>{"N0"});
    CHECK(ReportReached(route, order, 2) == std::vector<std::string>{"N1", "N2"});
    CHECK(ReportReached(route, order, 2).empty());
    CHECK_FALSE(route.IsReached());
    CHECK(ReportReached(route, order, 3) == std::vector<std::string>{"N3"});
    CHECK(route.IsReached());
}

TEST_CASE("6.6.2 An update continues at the last released node, in place of the horizon and its actions")
{
    OrderMessage order = MakeOrder(4, 2);
    order.nodes.at(3).actions.push_back(MakeAction("planned", EBlockingType::None));
    AcceptedRoute route;
    route.Extend(order);
    CHECK(route.GetDecisionPoint() == std::pair(std::string("N1"), order.nodes.at(1).sequenceID));
    CHECK(route.ListActionIDs().contains("planned"));
    OrderMessage update = MakeOrder(3, 3);
    update.nodes.erase(update.nodes.begin());
    update.edges.erase(update.edges.begin());
    update.edges.front().actions.push_back(MakeAction("new", EBlockingType::None));
    route.Extend(update);
    CHECK(route.GetDecisionPoint() == std::pair(std::string("N2"), update.nodes.back().sequenceID));
    CHECK(route.ListActionIDs() == std::set<std::string_view>{"new"});
}

} // namespace ACS::VDA5050::Test

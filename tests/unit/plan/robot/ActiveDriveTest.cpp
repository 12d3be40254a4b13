#include "robot/ActiveDrive.hpp"

#include "Catch.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

/// Over A, B, C and D, of which the first two are released.
ActiveDrive MakeDrive()
{
    ActiveDrive drive;
    for (const char* nodeID : {"A", "B", "C", "D"})
    {
        RouteNode node;
        node.nodeID = nodeID;
        drive.nodes.push_back(drive.route.nodes.size());
        drive.route.nodes.push_back(node);
    }
    drive.releasedCount = 2;
    return drive;
}

} // namespace

TEST_CASE("ActiveDrive: the base ends on the last released node unless that is the target")
{
    ActiveDrive drive = MakeDrive();
    CHECK_FALSE(drive.IsAtBaseEnd());
    drive.passed = 1;
    CHECK(drive.IsAtBaseEnd());
    drive.releasedCount = 4;
    CHECK_FALSE(drive.IsAtBaseEnd());
    drive.passed = 3;
    CHECK_FALSE(drive.IsAtBaseEnd());
}

TEST_CASE("ActiveDrive: a robot whose load changes may continue up to the first edge that its new load may not use")
{
    std::vector<SiteNode> nodes;
    std::vector<SiteEdge> edges;
    ActiveDrive drive = MakeDrive();
    for (const RouteNode& node : drive.route.nodes)
    {
        nodes.push_back({node.nodeID, static_cast<double>(nodes.size()), 0, "", {{"lr", std::nullopt}}});
    }
    for (const auto& [from, to] : {std::pair("A", "B"), std::pair("B", "C"), std::pair("C", "D")})
    {
        SiteEdgeRule rule;
        rule.vehicleTypeID = "lr";
        rule.loadRestriction = SiteLoadRestriction{true, to == std::string("B")};
        edges.push_back({std::string(from) + to, from, to, {rule}});
        RouteEdge edge;
        edge.edgeID = edges.back().edgeID;
        drive.route.edges.push_back(edge);
    }
    const SiteMap site = *SiteMap::Create(nodes, edges, {});
    drive.load = ELoad::Empty;
    drive.grantedCount = 1;
    CHECK(drive.CountReachable(site, "lr", ELoad::Empty) == 4);
    CHECK(drive.CountReachable(site, "lr", ELoad::Loaded) == 2);
    drive.grantedCount = 3; // The robot may be on its way there.
    CHECK(drive.CountReachable(site, "lr", ELoad::Loaded) == 3);
}

TEST_CASE("ActiveDrive: the robot approaches from the last node before the target on")
{
    ActiveDrive drive = MakeDrive();
    drive.passed = 1;
    CHECK_FALSE(drive.IsApproaching());
    CHECK(drive.GetNextNodeID() == "C");
    drive.passed = 2;
    CHECK(drive.IsApproaching());
    drive.passed = 3;
    CHECK(drive.IsApproaching());
    CHECK(drive.GetNextNodeID() == "D");
}

TEST_CASE("ActiveDrive: a cancellation after its requester has ended is late")
{
    ActiveDrive drive = MakeDrive();
    drive.StopAwaitingCancellation();
    CHECK(drive.cancellation == ECancellation::None);
    drive.cancellation = ECancellation::Awaited;
    CHECK(drive.IsCancelling());
    drive.StopAwaitingCancellation();
    CHECK_FALSE(drive.IsCancelling());
    CHECK(drive.cancellation == ECancellation::Late);
}

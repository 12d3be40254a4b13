#include "robot/ActiveDrive.hpp"

#include "Catch.hpp"

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

#include "Catch.hpp"
#include <acs/acsd/NodeByNodeDrive.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace ACS::Acsd::Test
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;
using Step = NodeByNodeDrive::Step;

/// Drive D from N1 to N3, of which `released` nodes are released.
Planning::Drive MakeDriveOfNodes(std::size_t released)
{
    Planning::Drive drive;
    drive.driveID = "D";
    for (const char* node : {"N1", "N2", "N3"})
    {
        Planning::RouteNode routeNode;
        routeNode.nodeID = node;
        drive.route.nodes.push_back(routeNode);
    }
    drive.releasedCount = released;
    return drive;
}

/// What the drive raises for a robot that is stationary on the node.
AdapterActions ReportStationary(NodeByNodeDrive& drive, const std::string& node)
{
    AdapterActions out;
    drive.OnStationary(node, out);
    return out;
}

} // namespace

TEST_CASE("A robot is sent from node to node, as far as the nodes are released")
{
    NodeByNodeDrive drive;
    CHECK_FALSE(drive.HasDrive());
    CHECK(ReportStationary(drive, "N1").empty());

    drive.Handle(MakeDriveOfNodes(2));
    CHECK(drive.HasDrive());
    CHECK(drive.GetStepOrNull() == std::nullopt); // the robot may be on its way
    CHECK(ReportStationary(drive, "N1") == AdapterActions{RaiseEvent{Planning::NodePassed{"D", "N1"}}});
    CHECK(drive.GetStepOrNull() == Step{"D", "N2"});
    CHECK(ReportStationary(drive, "N1").empty());
    CHECK(drive.GetStepOrNull() == Step{"D", "N2"});

    CHECK(ReportStationary(drive, "N2") == AdapterActions{RaiseEvent{Planning::NodePassed{"D", "N2"}}});
    CHECK(drive.GetStepOrNull() == std::nullopt);
    drive.Handle(Planning::ExtendDrive{"another", 3});
    CHECK(drive.GetStepOrNull() == std::nullopt);
    drive.Handle(Planning::ExtendDrive{"D", 3});
    CHECK(drive.GetStepOrNull() == Step{"D", "N3"});

    CHECK(
        ReportStationary(drive, "N3")
        == AdapterActions{RaiseEvent{Planning::NodePassed{"D", "N3"}}, RaiseEvent{Planning::Arrived{"D"}}});
    CHECK_FALSE(drive.HasDrive());
    CHECK(drive.GetStepOrNull() == std::nullopt);
    CHECK(ReportStationary(drive, "N3").empty());
}

TEST_CASE("A drive from another node than the robot's, and one that the robot has left, are rejected")
{
    NodeByNodeDrive drive;
    drive.Handle(MakeDriveOfNodes(2));
    const AdapterActions rejected{RaiseEvent{Planning::DriveRejected{"D", "the robot is at \"N2\""}}};
    CHECK(ReportStationary(drive, "N2") == rejected);
    CHECK_FALSE(drive.HasDrive());

    drive.Handle(MakeDriveOfNodes(3));
    CHECK(ReportStationary(drive, "N1").size() == 1);
    CHECK(
        ReportStationary(drive, "N3")
        == AdapterActions{RaiseEvent{Planning::DriveRejected{"D", "the robot is at \"N3\""}}});
    CHECK(drive.GetStepOrNull() == std::nullopt);

    drive.Handle(Planning::Drive{"D", {}, 1});
    CHECK(ReportStationary(drive, "N2") == rejected);
}

TEST_CASE("A cancelled drive ends on the next node, or has arrived if that is the last one")
{
    NodeByNodeDrive drive;
    drive.Handle(MakeDriveOfNodes(3));
    CHECK(ReportStationary(drive, "N1").size() == 1);
    drive.Handle(Planning::CancelDrive{"another"});
    CHECK(drive.GetStepOrNull() == Step{"D", "N2"});
    drive.Handle(Planning::CancelDrive{"D"});
    CHECK(drive.GetStepOrNull() == std::nullopt);
    CHECK(
        ReportStationary(drive, "N2")
        == AdapterActions{
            RaiseEvent{Planning::NodePassed{"D", "N2"}},
            RaiseEvent{Planning::DriveCancelled{"D", "N2"}}});
    CHECK_FALSE(drive.HasDrive());

    drive.Handle(MakeDriveOfNodes(3));
    CHECK(ReportStationary(drive, "N1").size() == 1);
    CHECK(ReportStationary(drive, "N2").size() == 1);
    drive.Handle(Planning::CancelDrive{"D"});
    CHECK(
        ReportStationary(drive, "N3")
        == AdapterActions{RaiseEvent{Planning::NodePassed{"D", "N3"}}, RaiseEvent{Planning::Arrived{"D"}}});

    drive.Handle(Planning::CancelDrive{"D"}); // it has ended already
    drive.Handle(MakeDriveOfNodes(3));
    CHECK(ReportStationary(drive, "N1").size() == 1);
    CHECK(drive.GetStepOrNull() == Step{"D", "N2"});
}

TEST_CASE("A paused robot is not sent on, and arrives all the same")
{
    NodeByNodeDrive drive;
    drive.Handle(Planning::Pause{});
    CHECK(drive.IsPaused());
    drive.Handle(MakeDriveOfNodes(3));
    CHECK(ReportStationary(drive, "N1").size() == 1);
    CHECK(drive.GetStepOrNull() == std::nullopt);
    drive.Handle(Planning::Resume{});
    CHECK_FALSE(drive.IsPaused());
    CHECK(drive.GetStepOrNull() == Step{"D", "N2"});
    CHECK(ReportStationary(drive, "N2").size() == 1);
    drive.Handle(Planning::Pause{});
    CHECK(ReportStationary(drive, "N3").size() == 2);
    CHECK_FALSE(drive.HasDrive());
}

} // namespace ACS::Acsd::Test

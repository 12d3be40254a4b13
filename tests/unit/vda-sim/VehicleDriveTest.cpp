#include "vda-sim/VehicleDrive.hpp"

#include "Catch.hpp"
#include "VehicleDriver.hpp"

#include <optional>
#include <string>
#include <utility>

namespace ACS::Testing
{
namespace
{

using VdaSim::EFaultKind;
using VdaSim::Fault;
using VdaSim::FaultBoard;
using VdaSim::VehicleDrive;

constexpr double STEP_SECONDS = 0.02;

/// The leg from N0 to N1.
VDA5050::DriveTo MakeFirstLeg()
{
    VDA5050::DriveTo leg;
    leg.edge.edgeID = "N0-N1";
    leg.edge.maxSpeed = 1.0;
    leg.node.nodeID = "N1";
    leg.node.sequenceID = 2;
    leg.node.nodePosition = VDA5050::NodePosition{};
    leg.node.nodePosition->x = 10.0;
    leg.node.nodePosition->mapID = "upstairs";
    leg.bStopAtNode = true;
    return leg;
}

FaultBoard MakeBoard(std::optional<Fault> faultOrNull = {})
{
    FaultBoard board;
    VdaSim::FaultChanges changes;
    if (faultOrNull.has_value())
    {
        board.Add(std::move(*faultOrNull), {}, changes);
    }
    return board;
}

FaultBoard MakeObstacle(double swerve)
{
    Fault fault;
    fault.kind = EFaultKind::Blocked;
    fault.swerve = swerve;
    return MakeBoard(std::move(fault));
}

/// Advances until the leg ends or the vehicle is stationary; whether the leg has ended.
bool HasReachedNode(VehicleDrive& drive)
{
    bool bReached = false;
    while (!bReached && drive.IsMoving())
    {
        bReached = drive.Advance(STEP_SECONDS).reached.has_value();
    }
    return bReached;
}

struct DriveFixture
{
    Planning::SiteMap site = MakeTestSite();
    VehicleDrive drive{site, {}, "N0", std::nullopt};
};

} // namespace

TEST_CASE_METHOD(DriveFixture, "VehicleDrive: at the end of a leg the vehicle is on its node and its map")
{
    CHECK(drive.GetNodeID() == "N0");
    CHECK(drive.GetMapID() == "floor");
    drive.Begin(MakeFirstLeg());
    CHECK(HasReachedNode(drive));
    CHECK(drive.GetNodeID() == "N1");
    CHECK(drive.GetMapID() == "upstairs");
    CHECK(drive.GetLegOrNull() == nullptr);
    CHECK(drive.GetMotion().GetPose().x == Approx(10.0));
}

TEST_CASE_METHOD(DriveFixture, "VehicleDrive: a stop ends with the same leg, which continues where it is")
{
    drive.Begin(MakeFirstLeg());
    double metres = 0.0;
    while (drive.GetMotion().GetDriven() < 5.0)
    {
        metres += drive.Advance(STEP_SECONDS).metres;
    }
    CHECK(metres == Approx(drive.GetMotion().GetDriven()));
    drive.Stop();
    drive.UpdateBrake(MakeBoard());
    CHECK_FALSE(HasReachedNode(drive));
    CHECK(drive.GetLegOrNull() != nullptr);
    drive.Begin(MakeFirstLeg());
    drive.UpdateBrake(MakeBoard());
    CHECK(drive.GetMotion().GetDriven() > 5.0);
    CHECK(HasReachedNode(drive));
}

TEST_CASE_METHOD(
    DriveFixture,
    "VehicleDrive: an abandoned drive ends where the vehicle stops, also if it has to stop anyway")
{
    drive.Begin(MakeFirstLeg());
    while (drive.GetMotion().GetDriven() < 5.0)
    {
        static_cast<void>(drive.Advance(STEP_SECONDS));
    }
    drive.Abandon();
    drive.Stop();
    drive.EndAbandoned();
    CHECK(drive.GetLegOrNull() == nullptr);
    CHECK(drive.IsMoving());
    CHECK_FALSE(drive.TryPlace({10.0, 5.0, 0.0}, "floor"));
    drive.UpdateBrake(MakeBoard());
    CHECK_FALSE(HasReachedNode(drive));
    drive.EndAbandoned();
    CHECK_FALSE(drive.GetMotion().HasLeg());
    CHECK(drive.GetNodeID() == "N0");
    CHECK(drive.TryPlace({10.0, 5.2, 0.0}, "floor"));
    CHECK(drive.GetNodeID() == "N2");
}

TEST_CASE_METHOD(DriveFixture, "VehicleDrive: an obstacle blocks it unless the corridor of its edge has room")
{
    CHECK(drive.IsBlocked(MakeObstacle(0.0)));
    CHECK_FALSE(drive.IsBlocked(MakeObstacle(0.5))); // no edge yet: no corridor
    VDA5050::DriveTo leg = MakeFirstLeg();
    drive.Begin(leg);
    CHECK(drive.IsBlocked(MakeObstacle(0.5)));
    leg.edge.corridor = VDA5050::Corridor{};
    leg.edge.corridor->rightWidth = 0.6;
    drive.Begin(leg);
    CHECK_FALSE(drive.IsBlocked(MakeObstacle(0.5)));
    CHECK(drive.IsBlocked(MakeObstacle(0.7)));
    leg.edge.corridor->corridorReferencePoint = VDA5050::ECorridorReferencePoint::Contour;
    drive.Begin(leg);
    CHECK(drive.IsBlocked(MakeObstacle(0.5)));
    CHECK_FALSE(drive.IsBlocked(MakeBoard()));
}

} // namespace ACS::Testing

#include "RouteDrive.hpp"

#include "Catch.hpp"
#include "Vda5050Sample.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

RouteDrive MakeDrive(std::size_t nodeCount)
{
    OrderMessage order = MakeOrder(nodeCount, nodeCount);
    RouteDrive drive("N0");
    drive.Begin(order.nodes.front());
    drive.Append(std::move(order));
    return drive;
}

/// Whether each DriveTo stops at its node.
std::vector<bool> ListStops(const VehicleActions& out)
{
    std::vector<bool> stops;
    for (const DriveTo& driveTo : Pick<DriveTo>(out))
    {
        stops.push_back(driveTo.bStopAtNode);
    }
    return stops;
}

} // namespace

TEST_CASE("6.6 DriveTo is sent once, and again where the stop at the node has changed")
{
    RouteDrive drive = MakeDrive(2);
    VehicleActions out;
    REQUIRE(drive.TryEnterEdge());
    CHECK_FALSE(drive.TryEnterEdge());
    drive.DriveToFront(out);
    drive.DriveToFront(out);
    CHECK(ListStops(out) == std::vector{true});
    drive.Append(MakeOrder(2, 2));
    drive.DriveToFront(out);
    CHECK(ListStops(out) == std::vector{true, false});
}

TEST_CASE("6.6 A vehicle that was stopped is stationary when its owner reports it")
{
    RouteDrive drive = MakeDrive(3);
    VehicleActions out;
    drive.Stop(out);
    CHECK(out.empty());
    REQUIRE(drive.TryEnterEdge());
    drive.DriveToFront(out);
    CHECK(drive.TryChangeDriving(true));
    CHECK_FALSE(drive.TryChangeDriving(true));
    drive.Stop(out);
    CHECK(Pick<StopDriving>(out).size() == 1);
    CHECK(drive.IsBetweenNodes());
    CHECK_FALSE(drive.IsStationary());
    CHECK(drive.TryChangeDriving(false));
    CHECK(drive.IsStationary());
    CHECK_FALSE(drive.TryChangeDriving(false));
}

TEST_CASE("6.6 A stop may end without a change of driving")
{
    RouteDrive drive = MakeDrive(2);
    VehicleActions out;
    REQUIRE(drive.TryEnterEdge());
    drive.DriveToFront(out);
    drive.Stop(out);
    CHECK_FALSE(drive.IsStationary());
    CHECK(drive.TryChangeDriving(false));
    CHECK(drive.IsStationary());
}

TEST_CASE("6.6.3 A cancelled vehicle that is bound to nodes drives to the next one, which it shows until the end")
{
    RouteDrive drive = MakeDrive(4);
    VehicleActions out;
    REQUIRE(drive.TryEnterEdge());
    drive.DriveToFront(out);
    drive.Cancel(false, out);
    CHECK(Pick<StopDriving>(out).empty());
    CHECK(drive.GetRoute().GetSize() == 1);
    drive.DriveLastLeg(out);
    drive.DriveLastLeg(out);
    CHECK(ListStops(out) == std::vector{false, true});
    CHECK_FALSE(drive.CanFinishCancel());
    REQUIRE(drive.IsOnEdgeTo(drive.GetRoute().GetNodeSequenceID(0)));
    drive.LeaveEdge(true);
    CHECK(drive.IsEndReached());
    CHECK(drive.CanFinishCancel());
    drive.PassFrontNode();
    drive.Clear();
    StateMessage state;
    drive.Fill(state, true);
    CHECK(state.lastNodeID == "N1");
    CHECK(state.nodeStates.empty());
    CHECK_FALSE(drive.IsOnLastLeg());
}

TEST_CASE("6.1 Outside of its corridor a vehicle stops, and a cancel does not wait for the next node")
{
    OrderMessage order = MakeOrder(2, 2);
    order.edges.front().corridor = Corridor{0.5, 0.5, ECorridorReferencePoint::KinematicCenter};
    RouteDrive drive("N0");
    drive.Append(std::move(order));
    VehicleActions out;
    CHECK_FALSE(drive.HasCorridor());
    REQUIRE(drive.TryEnterEdge());
    drive.DriveToFront(out);
    REQUIRE(drive.HasCorridor());
    drive.Cancel(false, out);
    CHECK(drive.TryChangeCorridor(true, out));
    CHECK_FALSE(drive.TryChangeCorridor(true, out));
    CHECK(Pick<StopDriving>(out).size() == 1);
    CHECK_FALSE(drive.CanContinue());
    CHECK(drive.TryChangeDriving(false));
    CHECK(drive.CanFinishCancel());
    CHECK(drive.TryChangeCorridor(false, out));
    CHECK(drive.CanContinue());
    CHECK_FALSE(drive.CanFinishCancel());
}

} // namespace ACS::VDA5050::Test

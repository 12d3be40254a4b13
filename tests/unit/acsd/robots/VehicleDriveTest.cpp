#include "robots/VehicleDrive.hpp"

#include "Catch.hpp"
#include "robots/VehicleFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <utility>

namespace ACS::Acsd::Test
{

namespace
{

/// A to C, released to B, whose order was made.
VehicleDrive MakeSentDrive()
{
    Core::Result<VehicleDrive> drive = VehicleDrive::Create(MakeDrive());
    REQUIRE(drive);
    REQUIRE(drive->MakeOrder(ACCEPT));
    return std::move(*drive);
}

} // namespace

TEST_CASE("A drive without nodes makes no order")
{
    Planning::Drive drive = MakeDrive();
    drive.route = {};
    CHECK_FALSE(VehicleDrive::Create(drive));
}

TEST_CASE("The order of a drive has the engine's route, released as far as the engine has")
{
    Core::Result<VehicleDrive> drive = VehicleDrive::Create(MakeDrive());
    REQUIRE(drive);
    CHECK(drive->GetOrderID() == "D");
    const Core::Result<VDA5050::OrderMessage> order = drive->MakeOrder(ACCEPT);
    REQUIRE(order);
    REQUIRE(order->nodes.size() == 3);
    CHECK(order->nodes[1].bReleased);
    CHECK_FALSE(order->nodes[2].bReleased);
    CHECK(order->edges[1].maxSpeed == 0.4);
    CHECK(order->edges[1].bRotationAllowed == false);
}

TEST_CASE("An update is due when more is released, and only after the vehicle has confirmed the latest message")
{
    VehicleDrive drive = MakeSentDrive();
    drive.Extend(3);
    CHECK_FALSE(drive.IsUpdateDue());
    drive.OnConfirmed();
    REQUIRE(drive.IsUpdateDue());
    Core::Result<VDA5050::OrderMessage> update = drive.MakeUpdate(ACCEPT);
    REQUIRE(update);
    CHECK(update->orderUpdateID == 1);
    drive.OnUpdateSent();
    CHECK_FALSE(drive.IsUpdateDue());
    drive.OnConfirmed();
    CHECK_FALSE(drive.IsUpdateDue());
}

TEST_CASE("An order that the state of the vehicle has no room for releases fewer nodes")
{
    Core::Result<VehicleDrive> drive = VehicleDrive::Create(MakeDrive());
    REQUIRE(drive);
    drive->Extend(3);
    const Core::Result<VDA5050::OrderMessage> order =
        drive->MakeOrder([](const VDA5050::OrderMessage& candidate) -> Core::Result<void> {
            if (!candidate.nodes[2].bReleased)
            {
                return {};
            }
            return Core::Fail(VDA5050::EVda5050Error::NotSupported, "maximum length of the state", "", "");
        });
    REQUIRE(order);
    CHECK(order->nodes[1].bReleased);
    CHECK_FALSE(order->nodes[2].bReleased);
}

TEST_CASE("An abandoned drive is not extended, and keeps the reason")
{
    VehicleDrive drive = MakeSentDrive();
    drive.OnConfirmed();
    drive.Extend(3);
    drive.Abandon("no space");
    CHECK_FALSE(drive.IsUpdateDue());
    CHECK(drive.GetAbandonReasonOrNull() == "no space");
}

TEST_CASE("An abandoned drive that the vehicle refuses to cancel is cancelled again after a pause or the next node")
{
    Testing::ManualClock clock;
    VehicleDrive drive = MakeSentDrive();
    CHECK_FALSE(drive.IsCancelDue(clock.GetNow()));
    drive.Abandon("no space");
    CHECK(drive.IsCancelDue(clock.GetNow()));
    drive.OnCancelRefused(clock.GetNow());
    CHECK_FALSE(drive.IsCancelDue(clock.GetNow()));
    SECTION("A pause")
    {
        clock.Advance(VehicleDrive::CANCEL_PAUSE);
        CHECK(drive.IsCancelDue(clock.GetNow()));
    }
    SECTION("The next node")
    {
        drive.OnNodePassed("B");
        CHECK(drive.IsCancelDue(clock.GetNow()));
    }
}

TEST_CASE("A drive knows the node that was passed last")
{
    VehicleDrive drive = MakeSentDrive();
    CHECK(drive.GetLastPassedNodeID().empty());
    drive.OnNodePassed("A");
    drive.OnNodePassed("B");
    CHECK(drive.GetLastPassedNodeID() == "B");
}

} // namespace ACS::Acsd::Test

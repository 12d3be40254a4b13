#include "robots/LiftingVehicle.hpp"

#include <string>
#include <vector>

// The order that repeats the REQUIRED actions of a node before a job, and what is commanded after it.

namespace ACS::Acsd::Test
{

TEST_CASE("A job that is cancelled while actions are repeated is not sent")
{
    LiftingVehicle vehicle;
    const VDA5050::OrderMessage repetition = vehicle.BeginRepetition();
    vehicle.ShowRepetition(repetition, VDA5050::EActionStatus::Running);
    vehicle.Command(Planning::CancelJob{"J"});
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(vehicle.adapter.GetSession().GetOrderPhase() == VDA5050::EOrderPhase::Cancelling);
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK(vehicle.TakeOrders().empty());
}

TEST_CASE("A job is not sent after an outage while actions were repeated: it may be resolved")
{
    LiftingVehicle vehicle;
    const VDA5050::OrderMessage repetition = vehicle.BeginRepetition();
    vehicle.ShowRepetition(repetition, VDA5050::EActionStatus::Running);
    vehicle.adapter.OnLinkDown(vehicle.clock.GetNow(), vehicle.actions);
    vehicle.ComeOnline();
    vehicle.ShowRepetition(repetition, VDA5050::EActionStatus::Finished);
    CHECK(vehicle.TakeOrders().empty());
    CHECK(vehicle.TakeEvents<Planning::JobUnknown>().size() == 1);

    vehicle.Command(MakeJob("CassetteLoad")); // it was not resolved
    const std::vector<VDA5050::OrderMessage> orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].orderID != repetition.orderID);
}

TEST_CASE("What follows a cancelled repetition waits for its end, and repeats only the actions that have not finished")
{
    const bool bFinished = GENERATE(true, false);
    const bool bDrive = GENERATE(true, false);
    const bool bSameState = GENERATE(true, false);
    INFO((bFinished ? "finished" : "failed") << (bDrive ? ", drive" : ", job") << (bSameState ? ", one state" : ""));
    LiftingVehicle vehicle;
    const VDA5050::OrderMessage repetition = vehicle.BeginRepetition();
    vehicle.ShowRepetition(repetition, VDA5050::EActionStatus::Running);
    vehicle.Command(Planning::CancelJob{"J"});
    if (bDrive)
    {
        vehicle.Command(vehicle.MakeNextDrive());
    }
    else
    {
        Planning::StartJob job = MakeJob("CassetteLoad");
        job.commandID = "U2";
        vehicle.Command(job);
    }
    vehicle.state.actionStates[0].actionStatus =
        bFinished ? VDA5050::EActionStatus::Finished : VDA5050::EActionStatus::Failed;
    if (!bSameState)
    {
        vehicle.ShowState();
    }
    vehicle.ShowCancelled();
    const std::vector<VDA5050::OrderMessage> orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    std::vector<std::string> types;
    for (const VDA5050::Action& action : orders[0].nodes[0].actions)
    {
        types.push_back(action.actionType);
    }
    std::vector<std::string> expected;
    if (!bFinished)
    {
        expected = {"lift"};
    }
    else if (!bDrive)
    {
        expected = {"pick"};
    }
    CHECK(types == expected);
    CHECK((orders[0].orderID == "D2") == bDrive);
    CHECK(vehicle.TakeEvents<Planning::JobRejected>().empty());
}

TEST_CASE("A drive that waits for the end of a cancelled repetition has no part in it")
{
    LiftingVehicle vehicle;
    const VDA5050::OrderMessage repetition = vehicle.BeginRepetition();
    vehicle.Command(Planning::CancelJob{"J"});
    vehicle.Command(vehicle.MakeNextDrive());
    vehicle.Command(Planning::ExtendDrive{"D2", 2});
    vehicle.ShowRepetition(repetition, VDA5050::EActionStatus::Running);
    SECTION("sent once, as far as it is released")
    {
        vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
        vehicle.ShowCancelled();
        const std::vector<VDA5050::OrderMessage> orders = vehicle.TakeOrders();
        REQUIRE(orders.size() == 1);
        CHECK(orders[0].orderID == "D2");
        CHECK(orders[0].orderUpdateID == 0);
        CHECK(orders[0].nodes.back().bReleased);
        for (const Planning::DriveRejected& rejected : vehicle.TakeEvents<Planning::DriveRejected>())
        {
            CHECK(rejected.driveID != "D2");
        }
    }
    SECTION("cancelled, and never sent")
    {
        vehicle.Command(Planning::CancelDrive{"D2"});
        CHECK(vehicle.TakeEvents<Planning::DriveRejected>().back().driveID == "D2");
        vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
        vehicle.ShowCancelled();
        CHECK(vehicle.TakeOrders().empty());
    }
    for (const Planning::NodePassed& passed : vehicle.TakeEvents<Planning::NodePassed>())
    {
        CHECK(passed.driveID != "D2");
    }
}

TEST_CASE("A repetition after a restart has another orderId than the one that the vehicle shows of the same job")
{
    LiftingVehicle vehicle;
    vehicle.ShowAtNode(VDA5050::EActionStatus::Running);
    vehicle.LoseOrder();
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.commandID = "3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f5061";
    vehicle.state.orderID = "1-2a7c10-5b6d-4e8f-9a0b-1c2d3e4f5061";
    vehicle.ShowState();
    vehicle.Command(Planning::RecoverJob{job, {}});
    REQUIRE(vehicle.TakeEvents<Planning::JobUnknown>().size() == 1);
    vehicle.Command(job);
    CHECK(vehicle.TakeOrders().at(0).orderID == "2-2a7c10-5b6d-4e8f-9a0b-1c2d3e4f5061");
}

} // namespace ACS::Acsd::Test

#include "robots/VehicleFixture.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// A vehicle that shows this after acsd was restarted; the adapter was asked for the job J before.
struct RecoveryFixture : VehicleFixture
{
    RecoveryFixture(const std::string& orderID, std::optional<VDA5050::EActionStatus> statusOrNull)
    {
        state.orderID = orderID;
        if (statusOrNull.has_value())
        {
            VDA5050::ActionState action;
            action.actionID = "U1";
            action.actionType = "pick";
            action.actionStatus = *statusOrNull;
            state.actionStates.push_back(action);
        }
        Command(Planning::RecoverJob{MakeJob("CassetteLoad"), {"D"}});
        CHECK(actions.empty()); // the vehicle has reported nothing
        ComeOnline();
    }

    void ShowAction(VDA5050::EActionStatus status)
    {
        state.actionStates.at(0).actionStatus = status;
        ShowState();
    }
};

} // namespace

TEST_CASE("After a restart the end of a job whose action has ended is reported, and nothing is sent")
{
    RecoveryFixture done("U1", VDA5050::EActionStatus::Finished);
    CHECK(done.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    RecoveryFixture failed("U1", VDA5050::EActionStatus::Failed);
    CHECK(failed.TakeEvents<Planning::JobFailed>().size() == 1);
    RecoveryFixture later("another", VDA5050::EActionStatus::Finished); // an order after it keeps its state
    CHECK(later.TakeEvents<Planning::JobFinished>().size() == 1);
    done.ShowState();
    CHECK(done.TakeEvents<Planning::JobFinished>().size() == 1);
}

TEST_CASE("After a restart a job whose action runs is watched to its end, and the robot is not occupied by it")
{
    RecoveryFixture vehicle("U1", VDA5050::EActionStatus::Running);
    CHECK(vehicle.TakeEvents<Planning::JobStarted>() == std::vector<Planning::JobStarted>{{"J"}});
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    vehicle.ShowAction(VDA5050::EActionStatus::Finished);
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});
    CHECK(vehicle.TakeEvents<Planning::JobFailed>().empty());
    CHECK(vehicle.TakeOrders().empty());
    RecoveryFixture lost("U1", VDA5050::EActionStatus::Running);
    lost.state.orderID.clear();
    lost.state.actionStates.clear();
    lost.ShowState();
    CHECK(lost.TakeEvents<Planning::JobUnresolved>().size() == 1);
}

TEST_CASE(
    "After a restart the order before the job's shows that the vehicle never had it: it is sent, under the same id")
{
    RecoveryFixture vehicle("D", std::nullopt);
    CHECK(vehicle.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
    CHECK(vehicle.TakeOrders().empty());
    SECTION("sent")
    {
        vehicle.Command(MakeJob("CassetteLoad"));
        const auto orders = vehicle.TakeOrders();
        REQUIRE(orders.size() == 1);
        CHECK(orders[0].orderID == "U1");
    }
    SECTION("it arrived late after all: resumed, and not sent")
    {
        vehicle.state.orderID = "U1";
        vehicle.state.actionStates.push_back({"U1", "pick", "", VDA5050::EActionStatus::Running, ""});
        vehicle.ShowState();
        vehicle.Command(MakeJob("CassetteLoad"));
        CHECK(vehicle.TakeOrders().empty());
        CHECK(vehicle.TakeEvents<Planning::JobStarted>().size() == 1);
        vehicle.ShowAction(VDA5050::EActionStatus::Finished);
        CHECK(vehicle.TakeEvents<Planning::JobFinished>().size() == 1);
    }
}

TEST_CASE("After a restart an order that repeats actions before the job shows that the vehicle never had the job")
{
    for (const auto& [orderID, commandID] : {std::pair("1-U1", "U1"), std::pair("12-D", "D")})
    {
        INFO(orderID);
        RecoveryFixture vehicle(orderID, std::nullopt);
        CHECK(vehicle.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
        CHECK(vehicle.TakeEvents<Planning::JobUnresolved>().empty());
        CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().restartEvidence.commandID == commandID);
        vehicle.state.orderID = "another";
        vehicle.ShowState();
        CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().restartEvidence.commandID == "another");
    }
    for (const char* orderID : {"1-U2", "x-U1", "-U1", "01-U1", "1-"})
    {
        INFO(orderID);
        RecoveryFixture vehicle(orderID, std::nullopt);
        CHECK(vehicle.TakeEvents<Planning::JobUnresolved>().size() == 1);
        CHECK(vehicle.TakeEvents<Planning::JobUnknown>().empty());
        CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().restartEvidence.commandID == orderID);
    }
}

TEST_CASE("After a restart the job's own order without its action is no repetition, whatever its commandID begins with")
{
    VehicleFixture vehicle;
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.commandID = "12345678-5b6d-4e8f-9a0b-1c2d3e4f5061";
    vehicle.state.orderID = job.commandID;
    vehicle.Command(Planning::RecoverJob{job, {}});
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<Planning::JobUnresolved>().size() == 1);
    CHECK(vehicle.TakeEvents<Planning::JobUnknown>().empty());
}

TEST_CASE("After a restart no order, an unknown order or one without its action prove nothing of a job")
{
    for (const char* orderID : {"", "another", "U1"})
    {
        INFO(orderID);
        RecoveryFixture vehicle(orderID, std::nullopt);
        CHECK(vehicle.TakeEvents<Planning::JobUnresolved>().size() == 1);
        CHECK(vehicle.TakeEvents<Planning::JobUnknown>().empty());
        vehicle.state.orderID = "D"; // later evidence is none
        vehicle.ShowState();
        CHECK(vehicle.TakeEvents<Planning::JobUnknown>().empty());
    }
}

TEST_CASE("After a restart the released nodes ahead of a vehicle are reported until it has dropped its order")
{
    VehicleFixture vehicle;
    vehicle.state.orderID = "old";
    vehicle.state.nodeStates = {
        {"B", 2, "", true, std::nullopt},
        {"C", 4, "", true, std::nullopt},
        {"X", 6, "", false, std::nullopt}};
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().heldNodeIDs == std::vector<std::string>{"B", "C"});
    vehicle.state.nodeStates.clear();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().heldNodeIDs.empty());
}

} // namespace ACS::Acsd::Test

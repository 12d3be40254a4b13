#include "robots/ArmFixture.hpp"

#include <string>
#include <utility>
#include <vector>

// The REQUIRED actions of the node where a robot with an arm is, before its job.

namespace ACS::Acsd::Test
{

namespace
{

/// The base has driven from A to B, where its action "lift" has not finished: the order was lost.
struct UnfinishedNode : ArmFixture
{
    VDA5050::StateMessage state;
    Planning::StartJob job;

    UnfinishedNode()
    {
        adapter.OnLinkUp(clock.GetNow(), actions);
        BringUp();
        state.lastNodeID = "A";
        ShowState();
        Planning::Drive drive;
        drive.driveID = "D1";
        drive.releasedCount = 2;
        drive.route.nodes = {{"A", 0.0, 0.0, std::nullopt, "floor"}, {"B", 1.0, 0.0, std::nullopt, "floor"}};
        drive.route.nodes[1].actions.push_back(
            {"lift", "", Planning::EActionRequirement::Required, Planning::EActionBlocking::Hard, {}});
        drive.route.edges = {{"AB", "A", "B", 1.0, 1.0, std::nullopt, std::nullopt, "", std::nullopt}};
        adapter.Handle(drive, clock.GetNow(), actions);
        REQUIRE(TakeOrders().size() == 1);
        ShowAction("D1", 2, "D1-2-0", VDA5050::EActionStatus::Running);
        state.orderID.clear();
        state.actionStates.clear();
        ShowState();
        REQUIRE(TakeEvents<Planning::DriveRejected>().size() == 1);
        actions.clear();
        job.jobID = "J";
        job.commandID = "U1";
        job.action = "TrayLoad";
    }

    void ShowState()
    {
        state.header = {++headerID, clock.GetNow().wall, "2.0.0", "ACS", "CR01"};
        std::string payload;
        VDA5050::Vda5050Codec().Encode(state, VDA5050::EVda5050Version::Version200, payload);
        adapter.OnMqttMessage({"uagv/v2/ACS/CR01/state", payload, 0, false}, clock.GetNow(), actions);
    }

    /// At B with this order, whose only action has this status.
    void ShowAction(
        const std::string& orderID,
        std::uint32_t sequenceID,
        const std::string& actionID,
        VDA5050::EActionStatus status)
    {
        state.orderID = orderID;
        state.lastNodeID = "B";
        state.lastNodeSequenceID = sequenceID;
        VDA5050::ActionState action;
        action.actionID = actionID;
        action.actionType = "lift";
        action.actionStatus = status;
        state.actionStates = {action};
        ShowState();
    }

    std::vector<VDA5050::OrderMessage> TakeOrders()
    {
        std::vector<VDA5050::OrderMessage> orders;
        for (const VDA5050::MqttMessage& message : std::exchange(outputs.messages, {}))
        {
            if (message.topic.ends_with("/order"))
            {
                auto order = VDA5050::Vda5050Codec().Decode<VDA5050::OrderMessage>(message.payload);
                REQUIRE(order);
                orders.push_back(std::move(*order));
            }
        }
        return orders;
    }

    /// The id of the cancelOrder that was sent.
    std::string TakeCancelID()
    {
        for (const VDA5050::MqttMessage& message : std::exchange(outputs.messages, {}))
        {
            if (message.topic.ends_with("/instantActions"))
            {
                const auto sent = VDA5050::Vda5050Codec().Decode<VDA5050::InstantActionsMessage>(message.payload);
                REQUIRE(sent);
                return sent->actions.at(0).actionID;
            }
        }
        return {};
    }

    /// The order that repeats the action, which then runs.
    VDA5050::OrderMessage CommandJob()
    {
        adapter.Handle(job, clock.GetNow(), actions);
        CHECK(TakeRequests().empty());
        const std::vector<VDA5050::OrderMessage> orders = TakeOrders();
        REQUIRE(orders.size() == 1);
        REQUIRE(orders[0].nodes.size() == 1);
        CHECK(orders[0].nodes[0].nodeID == "B");
        REQUIRE(orders[0].nodes[0].actions.size() == 1);
        CHECK(orders[0].nodes[0].actions[0].actionType == "lift");
        ShowRepetition(orders[0], VDA5050::EActionStatus::Running);
        CHECK(TakeRequests().empty());
        return orders[0];
    }

    void ShowRepetition(const VDA5050::OrderMessage& order, VDA5050::EActionStatus status)
    {
        ShowAction(order.orderID, 0, order.nodes[0].actions[0].actionID, status);
    }
};

} // namespace

TEST_CASE("The arm starts when the base has repeated the actions of its node that had not finished")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.ShowRepetition(order, VDA5050::EActionStatus::Finished);
    CHECK(robot.TakeRequests() == std::vector<std::string>{SELECT});
    CHECK(robot.TakeOrders().empty());
    CHECK(robot.TakeEvents<Planning::Arrived>().empty());
    robot.Accept();
    robot.Accept("[6,5,0]");
    robot.DeliverData("[6,6,0]");
    CHECK(robot.TakeEvents<Planning::JobFinished>() == std::vector<Planning::JobFinished>{{"J"}});

    robot.job.jobID = "K";
    robot.job.commandID = "U2";
    robot.adapter.Handle(robot.job, robot.clock.GetNow(), robot.actions);
    CHECK(robot.TakeOrders().empty()); // nothing is open any more
    CHECK_FALSE(robot.TakeRequests().empty());
}

TEST_CASE("An action of the base's node that fails again rejects the job of the arm, which is not started")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.ShowRepetition(order, VDA5050::EActionStatus::Failed);
    const auto rejected = robot.TakeEvents<Planning::JobRejected>();
    REQUIRE(rejected.size() == 1);
    CHECK(rejected[0].jobID == "J");
    CHECK_THAT(rejected[0].reason, Catch::Contains("the action lift of the node B failed"));
    CHECK(robot.TakeEvents<Planning::DriveRejected>().empty());
    CHECK(robot.TakeRequests().empty());

    const VDA5050::OrderMessage again = robot.CommandJob();
    CHECK(again.orderID != order.orderID);
}

TEST_CASE("A job of the arm that is cancelled while the base repeats actions is not started")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.adapter.Handle(Planning::CancelJob{"J"}, robot.clock.GetNow(), robot.actions);
    CHECK(robot.TakeEvents<Planning::JobFailed>().size() == 1);
    CHECK(robot.adapter.GetSession().GetOrderPhase() == VDA5050::EOrderPhase::Cancelling);
    robot.ShowRepetition(order, VDA5050::EActionStatus::Finished);
    CHECK(robot.TakeRequests().empty());
}

TEST_CASE(
    "The next job of the arm waits for the end of a cancelled repetition, whose finished actions are not repeated")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.adapter.Handle(Planning::CancelJob{"J"}, robot.clock.GetNow(), robot.actions);
    robot.job.jobID = "K";
    robot.job.commandID = "U2";
    robot.adapter.Handle(robot.job, robot.clock.GetNow(), robot.actions);
    const std::string cancelID = robot.TakeCancelID();
    robot.ShowRepetition(order, VDA5050::EActionStatus::Finished);
    CHECK(robot.TakeOrders().empty());
    robot.state.actionStates.push_back({cancelID, "cancelOrder", "", VDA5050::EActionStatus::Finished, ""});
    robot.ShowState();
    const std::vector<VDA5050::OrderMessage> orders = robot.TakeOrders();
    REQUIRE(orders.size() == 1);
    CHECK(orders[0].nodes[0].actions.empty());
    CHECK(robot.TakeRequests().empty());
    robot.state.orderID = orders[0].orderID;
    robot.state.actionStates.clear();
    robot.ShowState();
    CHECK(robot.TakeRequests() == std::vector<std::string>{SELECT});
}

TEST_CASE("An arm that is lost while the base repeats actions returns its job when they have finished")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.Deliver(OpenStream::ClientLost{});
    CHECK(robot.TakeEvents<Planning::JobUnknown>().empty());
    robot.ShowRepetition(order, VDA5050::EActionStatus::Finished);
    CHECK(robot.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});
}

TEST_CASE("A job of the arm is not started after an outage while the base repeated actions: it may be resolved")
{
    UnfinishedNode robot;
    const VDA5050::OrderMessage order = robot.CommandJob();
    robot.Deliver(OpenStream::ClientLost{});
    robot.BringUp();
    robot.ShowRepetition(order, VDA5050::EActionStatus::Finished);
    CHECK(robot.TakeRequests().empty());
    CHECK(robot.TakeEvents<Planning::JobUnknown>() == std::vector<Planning::JobUnknown>{{"J"}});

    robot.adapter.Handle(robot.job, robot.clock.GetNow(), robot.actions); // it was not resolved
    CHECK(robot.TakeOrders().empty());
    CHECK(robot.TakeRequests() == std::vector<std::string>{SELECT});
}

} // namespace ACS::Acsd::Test

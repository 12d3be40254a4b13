#include "robots/OperatorActions.hpp"

#include "robots/ArmFixture.hpp"
#include "robots/VehicleFixture.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using VDA5050::EActionStatus;

/// A vehicle of which an operator requests instant actions.
struct RequestedVehicle : VehicleFixture
{
    RequestedVehicle()
    {
        ComeOnline();
    }

    tl::expected<std::string, RobotActionRefusal> Request(
        const std::string& actionType,
        const std::vector<RobotActionParameter>& parameters = {})
    {
        return adapter.RequestAction({actionType, parameters}, clock.GetNow(), actions);
    }

    /// The id.
    std::string Send(const std::string& actionType = "logReport")
    {
        const std::vector<RobotActionParameter> reason{{"reason", Core::JsonText::FromString("test")}};
        const auto sent = Request(actionType, actionType == "logReport" ? reason : std::vector<RobotActionParameter>());
        REQUIRE(sent.has_value());
        return *sent;
    }

    void Show(const std::string& actionID, EActionStatus status, const std::string& result = {})
    {
        state.actionStates = {{actionID, "logReport", "", status, result}};
        ShowState();
    }

    [[nodiscard]] std::vector<RobotActionChange> TakeChanges()
    {
        return std::exchange(outputs.actionChanges, {});
    }

    [[nodiscard]] std::size_t CountSent(std::string_view actionID)
    {
        const auto isMeant = [actionID](const VDA5050::MqttMessage& message) {
            return message.topic.ends_with("/instantActions") && message.payload.find(actionID) != std::string::npos;
        };
        return static_cast<std::size_t>(std::ranges::count_if(outputs.messages, isMeant));
    }

    void Connect(VDA5050::EConnectionState connectionState)
    {
        VDA5050::ConnectionMessage connection;
        connection.connectionState = connectionState;
        Receive("connection", connection);
    }
};

} // namespace

TEST_CASE_METHOD(RequestedVehicle, "The outcome of a requested action is that of the vehicle's states")
{
    const std::string actionID = Send();
    CHECK(CountSent(actionID) == 1);
    CHECK(TakeChanges().empty());
    Show(actionID, EActionStatus::Running);
    Show(actionID, EActionStatus::Running);
    CHECK(TakeChanges() == std::vector{RobotActionChange{actionID, ERobotActionStatus::Running, ""}});
    const bool bDone = GENERATE(true, false);
    Show(actionID, bDone ? EActionStatus::Finished : EActionStatus::Failed, "log-7");
    const ERobotActionStatus status = bDone ? ERobotActionStatus::Finished : ERobotActionStatus::Failed;
    CHECK(TakeChanges() == std::vector{RobotActionChange{actionID, status, "log-7"}});
    state.actionStates.clear();
    ShowState();
    CHECK(TakeChanges().empty());
}

TEST_CASE_METHOD(RequestedVehicle, "A vehicle that no longer shows an action has lost it: Unknown")
{
    const std::string actionID = Send();
    ShowState();
    CHECK(TakeChanges().empty()); // not yet shown
    Show(actionID, EActionStatus::Running);
    const bool bRestarted = GENERATE(true, false);
    if (bRestarted)
    {
        Connect(VDA5050::EConnectionState::ConnectionBroken);
        CHECK(TakeChanges().size() == 1);
        CHECK(TakeChanges().empty()); // it may still run
        Connect(VDA5050::EConnectionState::Online);
        state = VDA5050::StateMessage{};
        state.header = {0, clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    }
    state.actionStates.clear();
    ShowState();
    const std::vector<RobotActionChange> changes = TakeChanges();
    REQUIRE_FALSE(changes.empty());
    CHECK(
        changes.back()
        == RobotActionChange{actionID, ERobotActionStatus::Unknown, "The robot no longer reports the action."});
    Show(actionID, EActionStatus::Finished);
    CHECK(TakeChanges() == std::vector{RobotActionChange{actionID, ERobotActionStatus::Finished, ""}});
}

TEST_CASE_METHOD(RequestedVehicle, "An action that the vehicle refuses by an error has failed")
{
    const std::string actionID = Send(GENERATE(as<std::string>(), "logReport", "stateRequest"));
    state.errors = {{"instantActionError", {{"actionId", "other"}}, "no", "", VDA5050::EErrorLevel::Warning}};
    ShowState();
    CHECK(TakeChanges().empty());
    state.errors.push_back(
        {"instantActionError", {{"actionId", actionID}}, "no space", "", VDA5050::EErrorLevel::Warning});
    ShowState();
    CHECK(
        TakeChanges()
        == std::vector{RobotActionChange{actionID, ERobotActionStatus::Failed, "instantActionError: no space"}});
}

TEST_CASE_METHOD(RequestedVehicle, "An action that the vehicle does not show in time is not sent any more")
{
    const std::string actionID = Send();
    clock.Advance(std::chrono::seconds(10));
    const std::string laterID = Send();
    const auto starts = [this] {
        std::vector<Core::Duration> delays;
        for (const Planning::AdapterAction& action : std::exchange(actions, {}))
        {
            const auto* const startOrNull = std::get_if<Planning::StartAdapterTimer>(&action);
            if (startOrNull != nullptr && startOrNull->timer == OperatorActions::TIMER)
            {
                delays.push_back(startOrNull->delay);
            }
        }
        return delays;
    };
    CHECK(starts() == std::vector<Core::Duration>{OperatorActions::SHOW_TIMEOUT, std::chrono::seconds(20)});
    clock.Advance(std::chrono::seconds(20));
    adapter.OnTimer(OperatorActions::TIMER, clock.GetNow(), actions);
    CHECK(starts() == std::vector<Core::Duration>{std::chrono::seconds(10)});
    const std::vector<RobotActionChange> changes = TakeChanges();
    REQUIRE(changes.size() == 1);
    CHECK(changes[0].actionID == actionID);
    CHECK(changes[0].status == ERobotActionStatus::Unknown);
    outputs.messages.clear();
    adapter.OnTimer(
        static_cast<Planning::AdapterTimerID>(VDA5050::EMasterTimer::ResendInstantActions),
        clock.GetNow(),
        actions);
    CHECK(CountSent(actionID) == 0);
    CHECK(CountSent(laterID) == 1);
    Show(actionID, EActionStatus::Finished); // late
    CHECK(TakeChanges() == std::vector{RobotActionChange{actionID, ERobotActionStatus::Finished, ""}});
}

TEST_CASE_METHOD(RequestedVehicle, "An action that was not shown before a disconnection is not sent after it")
{
    const std::string shownID = Send();
    Show(shownID, EActionStatus::Running);
    const std::string actionID = Send();
    static_cast<void>(TakeChanges());
    const bool bOwnLink = GENERATE(true, false);
    if (bOwnLink)
    {
        adapter.OnLinkDown(clock.GetNow(), actions);
    }
    else
    {
        Connect(VDA5050::EConnectionState::Offline);
    }
    CHECK(
        TakeChanges()
        == std::vector{RobotActionChange{
            actionID,
            ERobotActionStatus::Unknown,
            "The robot was disconnected before it reported the action."}});
    CHECK(Request("stateRequest").error() == RobotActionRefusal{false, "The robot is not connected."});
    outputs.messages.clear();
    if (bOwnLink)
    {
        adapter.OnLinkUp(clock.GetNow(), actions);
    }
    Connect(VDA5050::EConnectionState::Online);
    Show(shownID, EActionStatus::Finished);
    CHECK(CountSent(actionID) == 0);
    CHECK(TakeChanges() == std::vector{RobotActionChange{shownID, ERobotActionStatus::Finished, ""}});
}

TEST_CASE_METHOD(RequestedVehicle, "In a mode without master control a vehicle is sent the two requests only")
{
    state.operatingMode = VDA5050::EOperatingMode::Manual;
    ShowState();
    const auto refused = Request("logReport", {{"reason", Core::JsonText::FromString("test")}});
    REQUIRE_FALSE(refused.has_value());
    CHECK_FALSE(refused.error().bInvalid);
    CHECK(refused.error().sentence.find("MANUAL") != std::string::npos);
    CHECK(Request("stateRequest").has_value());
    CHECK(Request("factsheetRequest").has_value());
}

TEST_CASE_METHOD(RequestedVehicle, "initPosition is not sent during an order, other actions are")
{
    const std::vector<RobotActionParameter> pose{
        {"x", Core::JsonText::FromNumber(1)},
        {"y", Core::JsonText::FromNumber(2)},
        {"theta", Core::JsonText::FromNumber(0)},
        {"mapId", Core::JsonText::FromString("floor-1")},
        {"lastNodeId", Core::JsonText::FromString("A")}};
    const auto wrong = Request("initPosition");
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().bInvalid);
    CHECK(Request("initPosition", pose).has_value());
    Command(MakeDrive());
    const auto refused = Request("initPosition", pose);
    REQUIRE_FALSE(refused.has_value());
    CHECK_FALSE(refused.error().bInvalid);
    CHECK(refused.error().sentence.starts_with("The robot executes an order"));
    CHECK(Request("stateRequest").has_value());
}

TEST_CASE_METHOD(RequestedVehicle, "An action that an operator has requested does not make the vehicle occupied")
{
    const std::string actionID = Send();
    state.orderID = "earlier";
    Show(actionID, EActionStatus::Running);
    CHECK_FALSE(TakeEvents<Planning::StateChanged>().back().bOccupied);
    Show("of-another-master", EActionStatus::Running);
    CHECK(TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE("A vehicle with an arm is sent the requested actions as well")
{
    ArmFixture robot;
    robot.ConnectWithBase();
    const auto sent = robot.adapter.RequestAction({"stateRequest", {}}, robot.clock.GetNow(), robot.actions);
    REQUIRE(sent.has_value());
    CHECK(robot.outputs.messages.back().payload.find(*sent) != std::string::npos);
}

} // namespace ACS::Acsd::Test

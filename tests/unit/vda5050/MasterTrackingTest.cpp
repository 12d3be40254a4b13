#include "MasterSteps.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

namespace ACS::VDA5050::Test
{

TEST_CASE("5.5 An action that vanishes before its end is reported as lost once; one that ended is not")
{
    MasterSessionFixture bench;
    SendFirstOrder(bench);
    const bool bEnded = GENERATE(true, false);
    bench.state.actionStates[0].actionStatus = bEnded ? EActionStatus::Failed : EActionStatus::Running;
    bench.SendState();
    bench.state.actionStates.clear();
    bench.SendState();
    bench.SendState();
    const auto lost = Pick<ActionLost>(bench.GetOutput());
    REQUIRE(lost.size() == (bEnded ? 0 : 1));
    CHECK((bEnded || lost[0] == ActionLost{"a1", "pick", "the vehicle no longer reports it"}));
}

TEST_CASE("5.5 The actions of an order that is lost end with it, and so does an instant action of a restarted vehicle")
{
    MasterSessionFixture bench;
    SendFirstOrder(bench);
    Action picture = MakeAction("i1", EBlockingType::None, "takePicture");
    REQUIRE(bench.session.SendInstantAction(picture, bench.GetNow(), bench.Clear()).has_value());
    bench.state.actionStates.push_back(ActionState{"i1", "takePicture", {}, EActionStatus::Running, {}});
    bench.SendState();
    CHECK(Pick<ActionLost>(bench.GetOutput()).empty());
    bench.state = StateMessage{};
    bench.SendState();
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    CHECK(Pick<ActionLost>(bench.GetOutput()).size() == 2);
}

TEST_CASE("5.5 An action that an update drops with its horizon is not lost")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    OrderMessage order = *builder.MakeOrder(2);
    order.nodes[3].actions.push_back(MakeAction("a3", EBlockingType::Hard));
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 3);
    bench.state.actionStates = {ActionState{"a3", "pick", {}, EActionStatus::Waiting, {}}};
    bench.SendState();
    const OrderMessage update = *builder.MakeUpdate(3, 0);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    bench.state.actionStates.clear();
    bench.Hold(bench.GetSentOrder(), 1);
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).size() == 1);
    CHECK(Pick<ActionLost>(bench.GetOutput()).empty());
}

TEST_CASE("13 Reserved are the nodes that the vehicle shows and those sent but not answered; a rejection frees them")
{
    MasterSessionFixture bench;
    bench.BeReady();
    CHECK(bench.session.ListReserved() == std::vector{ReservedElement{"N0", 0, false, true}});
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    const std::vector<ReservedElement> sent{{"N0", 0, false, true}, {"E0", 1, true, false}, {"N1", 2, false, false}};
    CHECK(bench.session.ListReserved() == sent);
    bench.Hold(order, 3);
    bench.state.edgeStates = {EdgeState{}};
    bench.state.edgeStates[0].edgeID = "E0";
    bench.state.edgeStates[0].sequenceID = 1;
    bench.state.edgeStates[0].bReleased = true;
    bench.SendState();
    std::vector<ReservedElement> base{{"N0", 0, false, true}, {"E0", 1, true, true}, {"N1", 2, false, true}};
    CHECK(bench.session.ListReserved() == base); // the horizon is not
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.session.ListReserved().size() == 5);
    // A cancel does not free anything by itself: the vehicle may have the update already.
    const std::string cancelID = CancelOrder(bench);
    CHECK(bench.session.ListReserved().size() == 5);
    bench.Connect(EConnectionState::ConnectionBroken);
    CHECK(bench.session.ListReserved().size() == 5);
    bench.Connect(EConnectionState::Online);
    bench.state.nodeStates.clear();
    bench.state.edgeStates.clear();
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, EActionStatus::Finished, {}}};
    bench.SendState();
    CHECK(bench.session.ListReserved() == std::vector{ReservedElement{"N0", 0, false, true}});
}

TEST_CASE("13 A master that resumes an order of which the vehicle has a later update numbers on from that")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    bench.Hold(order, 3);
    bench.state.orderUpdateID = 5;
    bench.SendState();
    REQUIRE(bench.session.ResumeOrder({{order}, {}}, bench.GetNow(), bench.Clear()).has_value());
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 5}});
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSentOrder().orderUpdateID == 6);
}

TEST_CASE("4.2 A rejected order that the vehicle finished between two states is reported as rejected and as finished")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Refuse(ErrorTypes::NO_ROUTE_ERROR, {{"orderId", "order-1"}, {"orderUpdateId", "0"}});
    bench.Hold(order, 0);
    bench.Clear();
    bench.SendState();
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderFinished>(bench.GetOutput()) == std::vector{OrderFinished{"order-1"}});
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
    CHECK(bench.session.CanTakeOrder());
}

TEST_CASE("4.2 A vehicle that runs the order of another master gets none, and the error states the reason")
{
    MasterSessionFixture bench;
    OrderMessage foreign = BeginForeignOrder(bench);
    CHECK_FALSE(bench.session.CanTakeOrder());
    const auto sent = bench.session.SendOrder(MakeOrder(3, 3), bench.GetNow(), bench.Clear());
    REQUIRE_FALSE(sent);
    CHECK(sent.error().code == EVda5050Error::OrderActive);
    CHECK(sent.error().found == "foreign");
    bench.Hold(foreign, 0);
    bench.SendState();
    CHECK(bench.session.CanTakeOrder());
}

TEST_CASE("4.2 An error that names the header of another master's message is no rejection")
{
    MasterSessionFixture bench;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(2, 2), bench.GetNow(), bench.Clear()).has_value());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    const std::string headerID = GENERATE("2", "99", "-1", "1x", "");
    bench.Refuse(ErrorTypes::VALIDATION_ERROR, {{"topic", "order"}, {"headerId", headerID}});
    CHECK(Pick<OrderRejected>(bench.GetOutput()).empty());
    bench.Refuse(ErrorTypes::VALIDATION_ERROR, {{"topic", "order"}, {"headerId", GENERATE("0", "1")}});
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 An update that waits gets a number above the one that the vehicle shows")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.state.orderUpdateID = 7;
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 7}});
    CHECK(bench.GetSentOrder().orderUpdateID == 8);
    bench.Clear();
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).empty());
    bench.state.orderUpdateID = 8;
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 8}});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty()); // its horizon is left
}

TEST_CASE("13 After the last orderUpdateId no update is sent")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(5);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    const OrderMessage update = *builder.MakeUpdate(3);
    const bool bWaiting = GENERATE(true, false);
    if (bWaiting)
    {
        REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    }
    bench.Clear();
    bench.Hold(order, 1);
    bench.state.orderUpdateID = std::numeric_limits<std::uint32_t>::max();
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == (bWaiting ? 1 : 0));
    CHECK(bench.GetSent(ETopic::Order).empty());
    const auto sent = bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear());
    REQUIRE_FALSE(sent.has_value());
    CHECK(sent.error().path == "orderUpdateId");
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    bench.state.orderUpdateID = 0; // it was a transient error of the vehicle
    bench.SendState();
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSentOrder().orderUpdateID == (bWaiting ? 2 : 1));
}

TEST_CASE("13 An update that was not sent yet is not accepted, and is sent with a number above the one shown")
{
    MasterOptions options = MakeMasterOptions();
    options.factsheet.emplace().protocolLimits.timing.minOrderInterval = 5.0;
    MasterSessionFixture bench(options);
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(5);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.SendState();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.GetSent(ETopic::Order).empty()); // it is delayed
    bench.state.orderUpdateID = 7;
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).empty());
    bench.Clear();
    bench.Wait(std::chrono::seconds(5), EMasterTimer::ResendOrder);
    CHECK(bench.GetSentOrder().orderUpdateID == 8);
    bench.Clear();
    bench.state.orderUpdateID = 8;
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 8}});
    bench.Clear();
    bench.Wait(std::chrono::seconds(5), EMasterTimer::ResendOrder);
    CHECK(bench.GetSentOrder().orderUpdateID == 9);
}

TEST_CASE("13 An update that was not sent yet is rejected when the vehicle shows the last orderUpdateId")
{
    MasterOptions options = MakeMasterOptions();
    options.factsheet.emplace().protocolLimits.timing.minOrderInterval = 5.0;
    MasterSessionFixture bench(options);
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(5);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.SendState();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear()).has_value());
    bench.state.orderUpdateID = std::numeric_limits<std::uint32_t>::max();
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).empty());
    CHECK(Pick<OrderRejected>(bench.GetOutput()).size() == 2);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    bench.Clear();
    bench.Wait(std::chrono::seconds(5), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).empty());
}

TEST_CASE("5.5 An action or error that a state repeats is reported once, and not again by the next state")
{
    MasterSessionFixture bench;
    bench.BeReady();
    bench.state.actionStates = {
        ActionState{"a1", "pick", {}, EActionStatus::Running, {}},
        ActionState{"a1", "pick", {}, EActionStatus::Finished, {}}};
    VehicleError error;
    error.errorType = "lost";
    bench.state.errors = {error, error};
    bench.Clear();
    bench.SendState();
    CHECK(Pick<ActionChanged>(bench.GetOutput()).size() == 1);
    CHECK(Pick<VehicleErrorChanged>(bench.GetOutput()).size() == 1);
    bench.Clear();
    bench.SendState();
    CHECK(Pick<ActionChanged>(bench.GetOutput()).empty());
    bench.state.errors.clear();
    bench.Clear();
    bench.SendState();
    CHECK(Pick<VehicleErrorChanged>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.5 Each change of thousands of actions and errors is reported once, in the order of the state")
{
    constexpr std::size_t COUNT = 5'000;
    MasterSessionFixture bench;
    bench.BeReady();
    OrderMessage order = MakeOrder(2, 2);
    for (std::size_t index = 0; index < COUNT; ++index)
    {
        const std::string actionID = "a" + std::to_string(index);
        order.nodes[1].actions.push_back(MakeAction(actionID, EBlockingType::None));
        bench.state.actionStates.push_back(ActionState{actionID, "pick", {}, EActionStatus::Waiting, {}});
        VehicleError error;
        error.errorType = "error" + std::to_string(index);
        bench.state.errors.push_back(error);
    }
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 0);
    bench.SendState();
    CHECK(Pick<ActionChanged>(bench.GetOutput()).size() == COUNT);
    CHECK(Pick<VehicleErrorChanged>(bench.GetOutput()).size() == COUNT);
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    bench.Clear();
    std::ranges::reverse(bench.state.actionStates);
    std::ranges::reverse(bench.state.errors);
    bench.state.errors.pop_back();
    bench.SendState();
    CHECK(Pick<ActionChanged>(bench.GetOutput()).empty());
    REQUIRE(Pick<VehicleErrorChanged>(bench.GetOutput()).size() == 1);
    CHECK(Pick<VehicleErrorChanged>(bench.GetOutput())[0].error.errorType == "error0");
    bench.Clear();
    for (ActionState& action : bench.state.actionStates)
    {
        action.actionStatus = EActionStatus::Finished;
    }
    bench.SendState();
    const auto changes = Pick<ActionChanged>(bench.GetOutput());
    REQUIRE(changes.size() == COUNT);
    CHECK(changes.front().actionID == "a4999");
    CHECK(changes.back().actionID == "a0");
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.6 A withdrawn instant action is not sent again; a late status of it is still reported")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const Action picture = MakeAction("i1", EBlockingType::None, "takePicture");
    REQUIRE(bench.session.SendInstantAction(picture, bench.GetNow(), bench.Clear()).has_value());
    bench.Clear();
    bench.Wait(MasterOptions{}.resendInterval, EMasterTimer::ResendInstantActions);
    REQUIRE(bench.GetSent(ETopic::InstantActions).size() == 1);
    CHECK_FALSE(bench.session.TryWithdrawInstantAction("i2"));
    REQUIRE(bench.session.TryWithdrawInstantAction("i1"));
    CHECK_FALSE(bench.session.TryWithdrawInstantAction("i1"));
    bench.Clear();
    bench.Wait(MasterOptions{}.resendInterval, EMasterTimer::ResendInstantActions);
    bench.Connect(EConnectionState::Offline);
    bench.Connect(EConnectionState::Online);
    for (const MqttMessage& message : bench.GetSent(ETopic::InstantActions))
    {
        CHECK(message.payload.find("takePicture") == std::string::npos);
    }
    bench.state.actionStates = {ActionState{"i1", "takePicture", {}, EActionStatus::Running, {}}};
    bench.SendState();
    CHECK(
        Pick<ActionChanged>(bench.GetOutput())
        == std::vector{ActionChanged{"i1", "takePicture", EActionStatus::Running, {}}});
}

TEST_CASE("4.2 An action that is sent while another is pending does not delay the resend of that one")
{
    MasterSessionFixture bench;
    bench.BeReady();
    for (const std::size_t timers : {std::size_t{1}, std::size_t{0}})
    {
        bench.Clear();
        Action pause;
        pause.actionType = ActionTypes::START_PAUSE;
        REQUIRE(bench.session.SendInstantAction(pause, bench.GetNow(), bench.Clear()));
        CHECK(Pick<StartMasterTimer>(bench.GetOutput()).size() == timers);
    }
}

} // namespace ACS::VDA5050::Test

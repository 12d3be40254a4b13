#include "MasterSteps.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

namespace ACS::VDA5050::Test
{

namespace
{

/// The order is accepted up to its second node, and an update to the third one is sent and not shown.
void BeginWithUpdate(MasterSessionFixture& bench, OrderBuilder& builder)
{
    REQUIRE(bench.session.SendOrder(*builder.MakeOrder(2), bench.GetNow(), bench.Clear()).has_value());
    const OrderMessage order = bench.GetSentOrder();
    bench.Hold(order, order.nodes.size() - 1);
    bench.SendState();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
}

} // namespace

TEST_CASE("5.4 A cancel of an order that has just ended finishes it")
{
    MasterSessionFixture bench;
    const OrderMessage order = SendFirstOrder(bench);
    const std::string cancelID = CancelOrder(bench);
    bench.Hold(order, 0);
    bench.state.actionStates[0].actionStatus = EActionStatus::Finished;
    bench.state.actionStates.push_back(ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}});
    bench.Refuse(ErrorTypes::NO_ORDER_TO_CANCEL, {{"actionId", cancelID}});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).empty());
    CHECK(Pick<ActionLost>(bench.GetOutput()).empty());
}

TEST_CASE("5.4 The order keeps running when the vehicle fails the cancel and continues")
{
    MasterSessionFixture bench;
    SendFirstOrder(bench);
    const std::string cancelID = CancelOrder(bench);
    bench.state.actionStates.push_back(ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}});
    bench.SendState();
    CHECK(Pick<CancelFailed>(bench.GetOutput()).size() == 1);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    CHECK(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value()); // and may be tried again
}

TEST_CASE("5.4 The order keeps running when the vehicle fails the cancel while an action runs at the last node")
{
    MasterSessionFixture bench;
    const OrderMessage order = SendFirstOrder(bench);
    bench.Hold(order, 0);
    bench.state.actionStates[0].actionStatus = EActionStatus::Running;
    bench.SendState();
    const std::string cancelID = CancelOrder(bench);
    bench.state.actionStates.push_back(ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}});
    bench.SendState();
    CHECK(Pick<CancelFailed>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).empty());
    CHECK(Pick<ActionLost>(bench.GetOutput()).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    bench.state.actionStates[0].actionStatus = EActionStatus::Finished;
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.4 An update that the vehicle shows when it fails the cancel is accepted, and the order continues after it")
{
    MasterSessionFixture bench;
    bench.session.SetHorizonOmitted(GENERATE(true, false));
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    BeginWithUpdate(bench, builder);
    const OrderMessage update = bench.GetSentOrder();
    const std::string cancelID = CancelOrder(bench);
    bench.Hold(update, update.nodes.size() - 1);
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}}};
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 1}});
    CHECK(Pick<CancelFailed>(bench.GetOutput()).size() == 1);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear()).has_value());
    CHECK(bench.GetSentOrder().orderUpdateID == 2);
    bench.Hold(bench.GetSentOrder(), 0);
    bench.SendState();
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N2", "N3"});
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.4 When the cancel fails, the updates that the vehicle has not shown are sent again with their numbers")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    BeginWithUpdate(bench, builder);
    const OrderMessage update = bench.GetSentOrder();
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(4), bench.GetNow(), bench.Clear()).has_value());
    const std::string cancelID = CancelOrder(bench);
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).empty());
    bench.Clear();
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}}};
    bench.SendState();
    CHECK(Pick<CancelFailed>(bench.GetOutput()).size() == 1);
    CHECK(
        Pick<StartMasterTimer>(bench.GetOutput())
        == std::vector{StartMasterTimer{EMasterTimer::ResendOrder, std::chrono::seconds(2)}});
    if (GENERATE(true, false)) // otherwise it arrives late
    {
        bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
        REQUIRE(bench.GetSent(ETopic::Order).size() == 1);
        CHECK(bench.GetSentOrder().orderUpdateID == 1);
        CHECK(bench.session.GetStatistics().ordersResent == 1);
    }
    bench.Clear();
    bench.Hold(update, 1);
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 1}});
    REQUIRE(bench.GetSent(ETopic::Order).size() == 1);
    CHECK(bench.GetSentOrder().orderUpdateID == 2);
}

TEST_CASE(
    "5.4 An order that the vehicle has completed when it fails the cancel is finished, even if never shown before")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    const std::string cancelID = CancelOrder(bench);
    bench.Hold(order, 0);
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, EActionStatus::Failed, {}}};
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 0}});
    CHECK(ListReached(bench.GetOutput()).size() == 3);
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).empty());
}

TEST_CASE("5.4 An update that reaches the vehicle after the cancel of its order is cancelled")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    BeginWithUpdate(bench, builder);
    const OrderMessage update = bench.GetSentOrder();
    const std::string cancelID = CancelOrder(bench);
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, EActionStatus::Finished, {}}};
    bench.SendState(); // the nodes are still shown
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).size() == 1);
    CHECK(Pick<OrderReappeared>(bench.GetOutput()).empty());
    bench.state.nodeStates.clear();
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()).empty());
    bench.Clear();
    bench.Hold(update, 1);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 1);
}

TEST_CASE(
    "5.4 A cancel of an order that was not sent ends it without cancelOrder, which would end another master's order")
{
    MasterOptions options = MakeMasterOptions();
    options.factsheet.emplace().protocolLimits.timing.minOrderInterval = 10;
    MasterSessionFixture bench(options);
    bench.BeReady();
    const OrderMessage first = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(first, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(first, 0);
    bench.SendState();
    OrderMessage second = MakeOrder(3, 3);
    second.orderID = "order-2";
    REQUIRE(bench.session.SendOrder(second, bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(Pick<OrderDelayed>(bench.GetOutput()).size() == 1);
    OrderMessage foreign = MakeOrder(3, 3);
    foreign.orderID = "foreign";
    bench.Hold(foreign, 2);
    bench.SendState();
    REQUIRE(bench.session.Cancel(bench.GetNow(), bench.Clear()).has_value());
    CHECK(Pick<OrderCancelled>(bench.GetOutput()) == std::vector{OrderCancelled{"order-2"}});
    bench.Wait(std::chrono::seconds(10), EMasterTimer::ResendOrder);
    CHECK(Pick<PublishMessage>(bench.GetOutput()).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE("5.4 An order that reaches the vehicle after its cancel is cancelled again automatically")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 3);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    const std::string first = CancelOrder(bench);
    bench.state.actionStates = {ActionState{first, "cancelOrder", {}, EActionStatus::Failed, {}}};
    bench.SendState();
    REQUIRE(Pick<OrderCancelled>(bench.GetOutput()).size() == 1);
    bench.Clear();
    bench.Hold(order, 2);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
    REQUIRE(bench.GetSent(ETopic::InstantActions).size() == 1);
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Cancelling);
    const auto again =
        Vda5050Codec().Decode<InstantActionsMessage>(bench.GetSent(ETopic::InstantActions).back().payload);
    bench.state.nodeStates.clear();
    bench.state.actionStates.push_back(
        ActionState{again->actions[0].actionID, "cancelOrder", {}, EActionStatus::Finished, {}});
    bench.SendState();
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).size() == 1);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()).size() == 1);
}

TEST_CASE("4.2 A rejected or never shown order that the vehicle executes after all is reported and cancelled")
{
    MasterOptions options = MakeMasterOptions();
    options.resendCount = 1;
    MasterSessionFixture bench(options);
    bench.BeReady();
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[2].actions.push_back(MakeAction("a1", EBlockingType::Hard));
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    if (GENERATE(true, false))
    {
        bench.Refuse(ErrorTypes::NO_ROUTE_ERROR, {{"orderId", "order-1"}, {"orderUpdateId", "0"}});
    }
    else
    {
        bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
        bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    }
    REQUIRE(Pick<OrderRejected>(bench.GetOutput()).size() == 1);
    CHECK(bench.session.CanTakeOrder());
    if (GENERATE(true, false))
    {
        // Another order meanwhile, which the vehicle refuses because of the first.
        OrderMessage other = MakeOrder(3, 3);
        other.orderID = "order-2";
        REQUIRE(bench.session.SendOrder(other, bench.GetNow(), bench.Clear()).has_value());
        bench.Hold(order, 2);
        bench.Refuse(ErrorTypes::ORDER_UPDATE_ERROR, {{"orderId", "order-2"}, {"orderUpdateId", "0"}});
    }
    const bool bNodesLeft = GENERATE(true, false);
    bench.Clear();
    bench.Hold(order, bNodesLeft ? 2 : 0);
    bench.state.actionStates = {ActionState{"a1", "pick", {}, EActionStatus::Running, {}}};
    if (bench.session.GetOrderPhase() == EOrderPhase::None)
    {
        bench.SendState();
        CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
        CHECK(bench.GetSent(ETopic::InstantActions).size() == 1);
    }
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Cancelling);
    CHECK(bench.session.GetOrderID() == "order-1");
    CHECK_FALSE(bench.session.CanTakeOrder());
}

TEST_CASE("4.2 A cancelOrder for another master's order is not sent again when that order has ended")
{
    MasterSessionFixture bench;
    OrderMessage foreign = BeginForeignOrder(bench);
    Action cancel;
    cancel.actionType = ActionTypes::CANCEL_ORDER;
    REQUIRE(bench.session.SendInstantAction(cancel, bench.GetNow(), bench.Clear()));
    bench.SendState();
    CHECK(Pick<InstantActionRejected>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 2);
    bench.Clear();
    SECTION("it is complete")
    {
        bench.Hold(foreign, 0);
    }
    SECTION("another one follows")
    {
        foreign.orderID = "next";
        bench.Hold(foreign, 2);
    }
    bench.SendState();
    REQUIRE(Pick<InstantActionRejected>(bench.GetOutput()).size() == 1);
    CHECK(Pick<InstantActionRejected>(bench.GetOutput())[0].reason == "the order has ended before it was cancelled");
    CHECK(Pick<CancelMasterTimer>(bench.GetOutput()).size() == 1);
}

TEST_CASE("5.4 An update that waits is not sent when the vehicle has cleared the order")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    REQUIRE(bench.session.SendOrder(*builder.MakeOrder(2), bench.GetNow(), bench.Clear()).has_value());
    REQUIRE(bench.session.SendOrderUpdate(*builder.MakeUpdate(3), bench.GetNow(), bench.Clear()).has_value());
    bench.Clear();
    bench.state.orderID = "order-1"; // cancelled by another master as soon as it came
    bench.SendState();
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 0}});
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetSent(ETopic::Order).empty());
}

TEST_CASE("5.4 An update that reaches the vehicle after it cleared the order is cancelled")
{
    MasterSessionFixture bench;
    bench.BeReady();
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.SendState();
    const OrderMessage update = *builder.MakeUpdate(3);
    REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
    bench.state.nodeStates.clear();
    bench.state.edgeStates.clear();
    bench.SendState();
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    bench.Clear();
    bench.Hold(update, 1);
    bench.state.orderUpdateID = 1;
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 1);
}

TEST_CASE("5.6 Neither an instant action that the vehicle shows nor the cancelOrder of Cancel can be withdrawn")
{
    MasterSessionFixture bench;
    SendFirstOrder(bench);
    const Action picture = MakeAction("i1", EBlockingType::None, "takePicture");
    REQUIRE(bench.session.SendInstantAction(picture, bench.GetNow(), bench.Clear()).has_value());
    bench.state.actionStates.push_back(ActionState{"i1", "takePicture", {}, EActionStatus::Running, {}});
    bench.SendState();
    CHECK_FALSE(bench.session.TryWithdrawInstantAction("i1"));
    CHECK_FALSE(bench.session.TryWithdrawInstantAction(CancelOrder(bench)));
}

TEST_CASE("5.4 A cancelOrder that was lost is not sent again when the vehicle has another order")
{
    MasterSessionFixture bench;
    OrderMessage order = SendFirstOrder(bench);
    CancelOrder(bench);
    order.orderID = "foreign";
    bench.Hold(order, 2);
    bench.SendState();
    REQUIRE(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    bench.Clear();
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
}

TEST_CASE("4.2 A cancelOrder that is sent before the first state is for the order that this state shows")
{
    MasterSessionFixture bench;
    OrderMessage foreign = MakeOrder(3, 3);
    foreign.orderID = "foreign";
    bench.Hold(foreign, 2);
    bench.Connect(EConnectionState::Online);
    Action cancel;
    cancel.actionType = ActionTypes::CANCEL_ORDER;
    REQUIRE(bench.session.SendInstantAction(cancel, bench.GetNow(), bench.Clear()));
    bench.Clear();
    bench.SendState();
    CHECK(Pick<InstantActionRejected>(bench.GetOutput()).empty());
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendInstantActions);
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 1);
    foreign.orderID = "next";
    bench.Hold(foreign, 2);
    bench.SendState();
    CHECK(Pick<InstantActionRejected>(bench.GetOutput()).size() == 1);
}

} // namespace ACS::VDA5050::Test

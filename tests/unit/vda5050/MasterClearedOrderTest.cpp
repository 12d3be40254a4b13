#include "MasterSteps.hpp"

#include <chrono>
#include <string>
#include <vector>

// Vehicles that show no orderId while they execute no order.

namespace ACS::VDA5050::Test
{

namespace
{

/// The vehicle has ended its order and cleared what it shows of it, except its last node.
void ClearOrder(StateMessage& state)
{
    state.orderID.clear();
    state.orderUpdateID = 0;
    state.nodeStates.clear();
    state.edgeStates.clear();
    state.actionStates.clear();
}

} // namespace

TEST_CASE("6.10 An order is finished if the vehicle shows its last node and no orderId any more")
{
    MasterSessionFixture bench;
    const OrderMessage order = SendFirstOrder(bench);
    bench.Hold(order, 1);
    bench.state.actionStates[0].actionStatus = EActionStatus::Finished;
    bench.SendState();
    const bool bAtEnd = GENERATE(true, false);
    if (bAtEnd)
    {
        bench.Hold(order, 0);
    }
    ClearOrder(bench.state);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == (bAtEnd ? 1 : 0));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (bAtEnd ? 0 : 1));
    CHECK(ListReached(bench.GetOutput()).size() == (bAtEnd ? 2 : 1));
    CHECK(bench.session.CanTakeOrder());
}

TEST_CASE("6.10 An order with more nodes to come is lost if the vehicle shows no orderId any more")
{
    MasterSessionFixture bench;
    bench.BeReady();
    const OrderMessage order = MakeOrder(3, 2);
    REQUIRE(bench.session.SendOrder(order, bench.GetNow(), bench.Clear()).has_value());
    bench.Hold(order, 1);
    bench.SendState();
    ClearOrder(bench.state);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
}

TEST_CASE("6.10 An order with one node and without an orderId is finished only if the end of its actions was shown")
{
    MasterSessionFixture bench;
    SendOrderWithAction(bench, 1, EActionStatus::Running);
    const bool bShown = GENERATE(true, false);
    ActionState ended = bench.state.actionStates[0];
    ended.actionStatus = EActionStatus::Finished;
    ClearOrder(bench.state);
    if (bShown)
    {
        bench.state.actionStates = {ended};
    }
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == (bShown ? 1 : 0));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (bShown ? 0 : 1));
    CHECK(Pick<ActionLost>(bench.GetOutput()).size() == (bShown ? 0 : 1));
}

TEST_CASE("6.6.3 The cancel of an order decides its outcome also if the vehicle shows no orderId any more")
{
    MasterSessionFixture bench;
    const OrderMessage order = SendFirstOrder(bench);
    const std::string cancelID = CancelOrder(bench);
    const EActionStatus status = GENERATE(EActionStatus::Finished, EActionStatus::Failed);
    const bool bAtEnd = GENERATE(true, false);
    if (bAtEnd)
    {
        bench.Hold(order, 0);
    }
    ClearOrder(bench.state);
    bench.state.actionStates = {ActionState{cancelID, "cancelOrder", {}, status, {}}};
    bench.SendState();
    const bool bFinished = bAtEnd && status == EActionStatus::Failed;
    CHECK(Pick<OrderLost>(bench.GetOutput()).empty());
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == (bFinished ? 1 : 0));
    CHECK(Pick<OrderCancelled>(bench.GetOutput()).size() == (bFinished ? 0 : 1));
}

TEST_CASE("6.10 An order is sent again to a vehicle that clears the orderId of the one before after the sending")
{
    struct Row
    {
        std::uint32_t sequenceBefore; ///< Of the node at which the vehicle is.
        std::string lastNodeID;       ///< That it shows without an orderId.
        std::uint32_t lastSequence;
        std::size_t nodes; ///< Of the order that was sent.
        bool bLost;
    };
    const Row row = GENERATE(
        Row{4, "N0", 4, 3, false},
        Row{4, "N0", 4, 1, false},
        Row{0, "N0", 0, 3, false},
        Row{0, "N0", 0, 1, true}, // it may have executed the order, and shows the same node
        Row{4, "N0", 0, 3, true}, // it accepted the order, or was restarted
        Row{4, "", 0, 3, true},
        Row{4, "N2", 4, 3, true});
    CAPTURE(row.sequenceBefore, row.lastNodeID, row.lastSequence, row.nodes);
    MasterSessionFixture bench;
    bench.state.orderID = "order-0";
    bench.state.lastNodeSequenceID = row.sequenceBefore;
    bench.BeReady();
    REQUIRE(bench.session.SendOrder(MakeOrder(row.nodes, row.nodes), bench.GetNow(), bench.Clear()).has_value());
    bench.state.orderID.clear();
    bench.state.lastNodeID = row.lastNodeID;
    bench.state.lastNodeSequenceID = row.lastSequence;
    bench.Clear();
    bench.SendState();
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (row.bLost ? 1 : 0));
    bench.Wait(std::chrono::seconds(2), EMasterTimer::ResendOrder);
    CHECK(bench.GetSent(ETopic::Order).size() == (row.bLost ? 0 : 1));
}

} // namespace ACS::VDA5050::Test

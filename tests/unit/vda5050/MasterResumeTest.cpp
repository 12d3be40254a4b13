#include "MasterSessionFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

namespace ACS::VDA5050::Test
{

namespace
{

/// The record of a master before it was killed: N0 to N4, an action on N1 and N3, in two messages.
struct Record
{
    OrderMessage order;
    OrderMessage update;

    Record()
    {
        std::vector<OrderNode> nodes = MakeNodes(5);
        nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard));
        nodes[3].actions.push_back(MakeAction("a3", EBlockingType::Hard));
        OrderBuilder builder = *OrderBuilder::Create("order-1", nodes, MakeEdges(4));
        order = *builder.MakeOrder(2);
        update = *builder.MakeUpdate(5);
    }
};

Core::Result<void> Resume(MasterSessionFixture& bench, OrderRecord record)
{
    return bench.session.ResumeOrder(std::move(record), bench.GetNow(), bench.Clear());
}

void Show(MasterSessionFixture& bench, std::string actionID, EActionStatus status)
{
    bench.state.actionStates.push_back(ActionState{std::move(actionID), "pick", {}, status, {}});
}

} // namespace

TEST_CASE("13 A resumed master sends nothing that the vehicle already shows, and continues from there")
{
    const Record record;
    MasterSessionFixture bench;
    bench.Hold(record.order, 3);
    Show(bench, "a1", EActionStatus::Running);
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order}, 0}));
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 0}});
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N0", "N1"});
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);

    REQUIRE(bench.session.SendOrderUpdate(record.update, bench.GetNow(), bench.Clear()));
    CHECK(bench.GetSentOrder().orderUpdateID == 1);
    bench.Hold(record.update, 0);
    Show(bench, "a3", EActionStatus::Finished);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty()); // a1 still runs, though the update does not name it
    bench.state.actionStates.front().actionStatus = EActionStatus::Finished;
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 The messages of a resumed order that the vehicle has not shown are sent one after the other")
{
    const Record record;
    MasterSessionFixture bench;
    const bool bFirstShown = GENERATE(true, false);
    if (bFirstShown)
    {
        bench.Hold(record.order, 3);
    }
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order, record.update}, {}}));
    if (!bFirstShown)
    {
        CHECK(bench.session.GetOrderPhase() == EOrderPhase::Sent);
        CHECK(bench.GetSentOrder().orderUpdateID == 0);
        bench.Hold(record.order, 3);
        bench.SendState();
    }
    CHECK(bench.GetSent(ETopic::Order).size() == (bFirstShown ? 1 : 2));
    CHECK(bench.GetSentOrder().orderUpdateID == 1);
    bench.Hold(record.update, 0);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    CHECK(ListReached(bench.GetOutput()).size() == 5);
}

TEST_CASE("13 A resumed order that was finished meanwhile is reported as finished at once")
{
    const Record record;
    MasterSessionFixture bench;
    bench.Hold(record.update, 0);
    Show(bench, "a1", EActionStatus::Finished);
    Show(bench, "a3", EActionStatus::Failed);
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order, record.update}, 0}));
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(bench.session.CanTakeOrder());
}

TEST_CASE("13 A resumed order that was accepted and that the vehicle has lost is reported as lost and not sent again")
{
    const Record record;
    MasterSessionFixture bench;
    bench.state.orderID = GENERATE("", "order-2");
    bench.state.operatingMode = GENERATE(EOperatingMode::Automatic, EOperatingMode::Manual);
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order}, 0}));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

TEST_CASE(
    "13 The update of a resumed order that the vehicle has cleared is not sent, and is cancelled if it comes late")
{
    const Record record;
    MasterSessionFixture bench;
    bench.Hold(record.order, 4);
    bench.state.nodeStates.clear();
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order, record.update}, 0}));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    CHECK(bench.GetSent(ETopic::Order).empty());
    bench.Clear();
    bench.Hold(record.update, 3);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
}

TEST_CASE("13 The update of a resumed order that the vehicle no longer shows is cancelled if it comes late")
{
    Record record;
    OrderMessage third = record.update;
    third.nodes.erase(third.nodes.begin(), third.nodes.begin() + 3);
    third.edges.clear();
    third.orderUpdateID = 2;
    MasterSessionFixture bench;
    bench.state = StateMessage();
    bench.state.orderID = GENERATE("", "order-2");
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order, record.update, third}, 0}));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == 1);
    bench.Clear();
    bench.Hold(record.update, 3);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()) == std::vector{OrderReappeared{"order-1"}});
    CHECK(bench.GetSent(ETopic::InstantActions).size() == 1); // cancelOrder
}

TEST_CASE("13 A resumed order whose horizon was not sent waits at the end of its base for an update")
{
    const Record record;
    MasterSessionFixture bench;
    bench.Hold(record.order, 3);
    bench.state.orderUpdateID = GENERATE(0U, 7U); // that of the record, or of an update that another client has sent
    bench.state.nodeStates.resize(GENERATE(as<std::size_t>(), 0, 1)); // without it, or shortened by the factsheet
    Show(bench, "a1", EActionStatus::Finished);
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order}, 0}));
    CHECK(Pick<OrderLost>(bench.GetOutput()).empty());
    CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
    CHECK(ListReached(bench.GetOutput()) == std::vector<std::string>{"N0", "N1"});
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);

    const std::uint32_t shownID = bench.state.orderUpdateID;
    REQUIRE(bench.session.SendOrderUpdate(record.update, bench.GetNow(), bench.Clear()));
    CHECK(bench.GetSentOrder().orderUpdateID == shownID + 1);
    bench.Hold(bench.GetSentOrder(), 0);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("13 A resumed order that the vehicle may have executed before it was restarted is reported as lost")
{
    struct Row
    {
        std::optional<std::string> before;
        std::string shown;
        bool bLost;
    };
    const Row row = GENERATE(
        Row{"", "", true},
        Row{"order-0", "", true},
        Row{"order-0", "order-2", true},
        Row{"order-0", "order-0", false},
        Row{std::nullopt, "", false},
        Row{std::nullopt, "order-2", false});
    CAPTURE(row.before.value_or("unknown"), row.shown);
    const Record record;
    MasterSessionFixture bench;
    bench.state.orderID = row.shown;
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order}, {}, row.before}));
    CHECK(Pick<OrderLost>(bench.GetOutput()).size() == (row.bLost ? 1 : 0));
    CHECK(bench.GetSent(ETopic::Order).size() == (row.bLost ? 0 : 1));
    CHECK(bench.session.GetOrderPhase() == (row.bLost ? EOrderPhase::None : EOrderPhase::Sent));
    bench.Clear();
    bench.Hold(record.order, 3);
    bench.SendState();
    CHECK(Pick<OrderReappeared>(bench.GetOutput()).size() == (row.bLost ? 1 : 0));
    CHECK(Pick<OrderAccepted>(bench.GetOutput()).size() == (row.bLost ? 0 : 1));
}

TEST_CASE("13 An order is resumed from a record without the update that was rejected")
{
    const Record record;
    OrderMessage update = record.update;
    update.orderUpdateID = 2; // 1 was rejected
    MasterSessionFixture bench;
    bench.Hold(update, 2);
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order, update}, 2}));
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 2}});
    CHECK(bench.GetSent(ETopic::Order).empty());
}

TEST_CASE("13 The updates of a resumed order are numbered on from the one that the vehicle shows")
{
    const Record record;
    MasterSessionFixture bench;
    bench.Hold(record.order, 3);
    bench.state.orderUpdateID = 7;
    bench.BeReady();
    REQUIRE(Resume(bench, {{record.order}, {}}));
    CHECK(Pick<OrderAccepted>(bench.GetOutput()) == std::vector{OrderAccepted{"order-1", 7}});
    REQUIRE(bench.session.SendOrderUpdate(record.update, bench.GetNow(), bench.Clear()));
    CHECK(bench.GetSentOrder().orderUpdateID == 8);
}

TEST_CASE("13 Nothing is resumed from an inconsistent record, without a ready vehicle, or beside a running order")
{
    const Record record;
    MasterSessionFixture bench;
    CHECK(Resume(bench, {{record.order}, {}}).error().code == EVda5050Error::VehicleNotReady);
    CHECK(Resume(bench, {{record.order}, 0}).error().code == EVda5050Error::VehicleNotReady);
    bench.state.operatingMode = EOperatingMode::Manual;
    bench.BeReady();
    CHECK(Resume(bench, {{record.order}, {}}).error().code == EVda5050Error::VehicleNotReady);
    bench.state.operatingMode = EOperatingMode::Automatic;
    bench.SendState();
    CHECK(Resume(bench, {}).error().code == EVda5050Error::InvalidOrder);
    CHECK(Resume(bench, {{record.update, record.order}, {}}).error().code == EVda5050Error::InvalidOrder);
    OrderMessage other = record.update;
    other.orderID = "order-2";
    CHECK(Resume(bench, {{record.order, other}, {}}).error().code == EVda5050Error::InvalidOrder);
    OrderMessage gap = MakeOrder(5, 5);
    gap.orderUpdateID = 1;
    CHECK(Resume(bench, {{record.order, gap}, {}}).error().code == EVda5050Error::InvalidOrder);
    OrderMessage third = record.update;
    third.nodes.erase(third.nodes.begin(), third.nodes.begin() + 3);
    third.edges.clear();
    third.orderUpdateID = 2;
    CHECK(Resume(bench, {{record.order, record.update, third}, {}}).error().code == EVda5050Error::InvalidOrder);
    CHECK(bench.GetSent(ETopic::Order).empty());
    REQUIRE(Resume(bench, {{record.order}, {}}));
    CHECK(Resume(bench, {{record.order}, {}}).error().code == EVda5050Error::OrderActive);
}

TEST_CASE("5.6 An instant action that the vehicle already shows is not sent again but is followed to its end")
{
    MasterSessionFixture bench;
    const bool bEnded = GENERATE(true, false);
    Show(bench, "i1", bEnded ? EActionStatus::Finished : EActionStatus::Running);
    bench.BeReady();
    const auto sent =
        bench.session.SendInstantAction(MakeAction("i1", EBlockingType::None), bench.GetNow(), bench.Clear());
    REQUIRE(sent);
    CHECK(*sent == "i1");
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
    const EActionStatus status = bEnded ? EActionStatus::Finished : EActionStatus::Running;
    CHECK(Pick<ActionChanged>(bench.GetOutput()) == std::vector{ActionChanged{"i1", "pick", status, {}}});
    bench.state.actionStates.clear();
    bench.SendState();
    CHECK(Pick<ActionLost>(bench.GetOutput()).size() == (bEnded ? 0 : 1));
}

TEST_CASE("5.6 An instant action with the id of another one, or of one that has not ended, is not sent")
{
    MasterSessionFixture bench;
    Show(bench, "a1", EActionStatus::Finished);
    bench.BeReady();
    const auto send = [&bench](std::string actionID, std::string actionType) {
        return bench.session.SendInstantAction(
            MakeAction(std::move(actionID), EBlockingType::None, std::move(actionType)),
            bench.GetNow(),
            bench.Clear());
    };
    CHECK(send("a1", "startPause").error().code == EVda5050Error::InvalidOrder);
    CHECK(send("a1", "stateRequest").error().code == EVda5050Error::InvalidOrder);
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
    REQUIRE(send("i1", "pick"));
    CHECK(send("i1", "pick").error().code == EVda5050Error::InvalidOrder);
    CHECK(bench.GetSent(ETopic::InstantActions).empty());
}

TEST_CASE("4.1 An order with the orderId that the vehicle shows is not sent: the vehicle would take it for an update")
{
    MasterSessionFixture bench;
    const OrderMessage order = MakeOrder(3, 3);
    bench.Hold(order, GENERATE(as<std::size_t>(), 0, 2));
    bench.BeReady();
    const auto sent = bench.session.SendOrder(order, bench.GetNow(), bench.Clear());
    REQUIRE_FALSE(sent);
    CHECK(sent.error().code == EVda5050Error::InvalidOrder);
    CHECK(sent.error().path == "orderId");
    CHECK(bench.GetSent(ETopic::Order).empty());
    CHECK(bench.session.GetOrderPhase() == EOrderPhase::None);
}

} // namespace ACS::VDA5050::Test

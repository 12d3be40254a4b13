#include "Catch.hpp"
#include "ChildProcess.hpp"
#include "LinkedMaster.hpp"

#include <chrono>
#include <csignal>
#include <string>

namespace ACS::Testing
{
namespace
{

using namespace VDA5050; // NOLINT(google-build-using-namespace): nearly every name of the test is one of it
using namespace std::chrono_literals;

constexpr std::chrono::seconds PATIENCE{20};

} // namespace

TEST_CASE("The vehicle example: an order with an action, a cancelled one, a rejected one, and the end")
{
    boost::asio::io_context context;
    const MosquittoBroker broker;
    ChildProcess program({ACS_EXAMPLE, "127.0.0.1", std::to_string(broker.GetPort()), "V1"});
    MasterOptions options;
    options.address = {"uagv", "Example", "V1"};
    options.resendInterval = 1s;
    LinkedMaster master(context, MakeOptions(broker.GetPort(), "master"), options);
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.session.CanTakeOrder(); },
        PATIENCE));

    std::vector<OrderNode> nodes = Test::MakeNodes(3);
    nodes[1].actions.push_back(Test::MakeAction("a1", EBlockingType::Hard, "beep"));
    const auto route = OrderBuilder::Create("order-1", nodes, Test::MakeEdges(2))->MakeOrder(3);
    REQUIRE(master.SendOrder(*route));
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.Count<OrderFinished>() == 1; },
        PATIENCE));
    CHECK(master.ListReached() == std::vector<std::uint32_t>{0, 2, 4});
    CHECK(master.GetStatusOrNull("a1") == EActionStatus::Finished);
    CHECK(program.TryWaitForText("order order-1 completed", PATIENCE));

    std::vector<OrderNode> back = Test::MakeNodes(3);
    std::ranges::reverse(back);
    REQUIRE(master.SendOrder(*OrderBuilder::Create("order-2", back, Test::MakeEdges(2))->MakeOrder(3)));
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.Count<OrderAccepted>() == 2; },
        PATIENCE));
    REQUIRE(master.Do([](auto& session, Core::Now now, auto& out) { return session.Cancel(now, out); }));
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.Count<OrderCancelled>() == 1; },
        PATIENCE));
    CHECK(program.TryWaitForText("order order-2 cancelled", PATIENCE));

    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.session.CanTakeOrder(); },
        PATIENCE));
    std::vector<OrderNode> elsewhere = Test::MakeNodes(3);
    elsewhere[0].nodePosition->mapID = "another-hall";
    REQUIRE(master.SendOrder(*OrderBuilder::Create("order-3", elsewhere, Test::MakeEdges(2))->MakeOrder(3)));
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.Count<OrderRejected>() == 1; },
        PATIENCE));
    CHECK(program.TryWaitForText("order order-3 refused", PATIENCE));

    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    REQUIRE(TryRunUntil(
        context,
        [&master]() { return master.Count<VehicleOffline>() == 1; },
        PATIENCE));
}

TEST_CASE("The vehicle example refuses a serial number that has no place in a topic")
{
    for (const char* const serialNumber : {"", "a/b", "+", "#", "$V1", "V\n1"})
    {
        CAPTURE(serialNumber);
        ChildProcess program({ACS_EXAMPLE, "127.0.0.1", "1", serialNumber});
        CHECK(program.TryWaitForText("Usage: e11_vehicle HOST PORT SERIALNUMBER", PATIENCE));
        CHECK(program.WaitForExitOrNull(PATIENCE) == 2);
    }
}

} // namespace ACS::Testing

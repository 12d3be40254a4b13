#include "AcsSessionFixture.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::AcsRequest;
using Protocol::ESessionTimer;
using Fixture = Testing::AcsSessionFixture;
using Testing::MakeAckText;
using Testing::MakeOptions;
using Testing::MakeStatus;

namespace
{

void SendStatuses(Fixture& bench, const std::vector<std::string>& robotIDs)
{
    for (const std::string& robotID : robotIDs)
    {
        const Protocol::AcsPayload status = MakeStatus(robotID, Protocol::ERobotStatus::Moving);
        bench.session.SendStatus(status, bench.clock.GetNow(), bench.recorder.out);
    }
}

/// The robot of a status, "request" for another request.
std::string Describe(const AcsRequest& request)
{
    const auto* statusOrNull = std::get_if<Protocol::RobotStatusUpdate>(&request.payload);
    return statusOrNull == nullptr ? "request" : statusOrNull->robotID;
}

/// Acknowledges the request. Returns the one that is sent then.
AcsRequest TakeTurn(Fixture& bench, const AcsRequest& request)
{
    bench.Text(MakeAckText(std::string(GetText(GetCommand(request))), request.transactionID));
    const std::vector<AcsRequest> sent = bench.recorder.GetRequests();
    REQUIRE(sent.size() == 1);
    return sent[0];
}

Protocol::SessionOptions MakeNarrowOptions()
{
    Protocol::SessionOptions options = MakeOptions();
    options.window = 1;
    return options;
}

} // namespace

TEST_CASE("9 At most sixteen messages wait for their Ack, and free room is reported once")
{
    Fixture bench;
    bench.StartAndReplay();
    for (int index = 0; index < 16; ++index)
    {
        REQUIRE(bench.session.GetRoom() == static_cast<std::size_t>(16 - index));
        REQUIRE(bench.TrySend(std::to_string(index)));
    }
    CHECK(bench.TrySend("3")); // in flight already: taken, not sent twice
    CHECK(bench.recorder.GetRequests().size() == 16);
    CHECK_FALSE(bench.TrySend("x"));
    bench.Text(MakeAckText("PlanReport", "7"));
    CHECK(bench.recorder.GetEvents<Protocol::WindowOpened>().size() == 1);
    bench.Text(MakeAckText("PlanReport", "8"));
    CHECK(bench.recorder.GetEvents<Protocol::WindowOpened>().empty());
    CHECK(bench.TrySend("x"));
}

TEST_CASE("9 Statuses are coalesced to the latest per robot when there is no room, except for Arrival and Stopped")
{
    using enum Protocol::ERobotStatus;
    Fixture bench(MakeNarrowOptions());
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    bench.recorder.Clear();
    for (const Protocol::ERobotStatus status : {Moving, Arrival, Arrival, Docking, Working, Stopped, Moving, Idle})
    {
        const Protocol::AcsPayload payload = MakeStatus("LR01", status);
        bench.session.SendStatus(payload, bench.clock.GetNow(), bench.recorder.out);
    }
    CHECK(bench.recorder.out.empty());
    bench.Text(MakeAckText("PlanReport", "a"));
    std::vector<Protocol::ERobotStatus> sent;
    while (!bench.recorder.GetRequests().empty())
    {
        const AcsRequest request = bench.recorder.GetRequests().at(0);
        sent.push_back(std::get<Protocol::RobotStatusUpdate>(request.payload).robotStatus);
        bench.Text(MakeAckText("RobotStatusUpdate", request.transactionID));
    }
    CHECK(sent == std::vector{Arrival, Stopped, Idle});
}

TEST_CASE("9 Room for several messages is used by all statuses of one robot that wait")
{
    using enum Protocol::ERobotStatus;
    Protocol::SessionOptions options = MakeOptions();
    options.window = 3;
    Fixture bench(options);
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    REQUIRE(bench.TrySend("b"));
    REQUIRE(bench.TrySend("c"));
    bench.session.SendStatus(MakeStatus("LR01", Arrival), bench.clock.GetNow(), bench.recorder.out);
    bench.session.SendStatus(MakeStatus("LR01", Docking), bench.clock.GetNow(), bench.recorder.out);
    bench.recorder.Clear();
    bench.clock.Advance(1s);
    bench.session.OnText(MakeAckText("PlanReport", "a"), bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnText(MakeAckText("PlanReport", "b"), bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetRequests().size() == 2);
}

TEST_CASE("9 An Arrival of an earlier connection is not sent again before the status that replaces it")
{
    using enum Protocol::ERobotStatus;
    Fixture bench(MakeOptions());
    bench.StartAndReplay();
    bench.session.SendStatus(MakeStatus("LR01", Arrival), bench.clock.GetNow(), bench.recorder.out);
    bench.Closed();
    bench.Timer(ESessionTimer::Reconnect, 10s);
    bench.Register();
    bench.session.SendStatus(MakeStatus("LR01", Working), bench.clock.GetNow(), bench.recorder.out);
    bench.recorder.Clear();
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    const auto requests = bench.recorder.GetRequests();
    REQUIRE(requests.size() == 1);
    CHECK(std::get<Protocol::RobotStatusUpdate>(requests.front().payload).robotStatus == Working);
}

TEST_CASE("9 The Arrivals that wait for room are limited per robot, and end with the connection")
{
    using enum Protocol::ERobotStatus;
    Fixture bench(MakeNarrowOptions());
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    for (int i = 0; i < 100; ++i)
    {
        bench.session.SendStatus(MakeStatus("LR01", Arrival), bench.clock.GetNow(), bench.recorder.out);
        bench.session.SendStatus(MakeStatus("LR01", Moving), bench.clock.GetNow(), bench.recorder.out);
    }
    std::size_t expected = 9; // eight Arrivals and the latest
    if (GENERATE(false, true))
    {
        bench.Closed();
        bench.session.SendStatus(MakeStatus("LR01", Arrival), bench.clock.GetNow(), bench.recorder.out);
        bench.session.SendStatus(MakeStatus("LR01", Idle), bench.clock.GetNow(), bench.recorder.out);
        bench.Timer(ESessionTimer::Reconnect, 10s);
        bench.Register();
        bench.recorder.Clear();
        bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
        expected = 1;
    }
    else
    {
        bench.Text(MakeAckText("PlanReport", "a"));
    }
    std::size_t sent = 0;
    while (!bench.recorder.GetRequests().empty())
    {
        ++sent;
        bench.Text(MakeAckText("RobotStatusUpdate", bench.recorder.GetRequests().at(0).transactionID));
    }
    CHECK(sent == expected);
}

TEST_CASE("9 Statuses that fill the window leave room for durable requests, and each robot has its turn")
{
    Fixture bench(MakeNarrowOptions());
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("first"));
    CHECK_FALSE(bench.TrySend("next"));
    std::map<std::string, int> sent;
    for (int round = 1; round <= 12; ++round)
    {
        const AcsRequest inFlight = bench.recorder.GetRequests().at(0);
        ++sent[Describe(inFlight)];
        SendStatuses(bench, {"LR01", "LR02"});
        bench.Text(MakeAckText(std::string(GetText(GetCommand(inFlight))), inFlight.transactionID));
        if (!bench.recorder.GetEvents<Protocol::WindowOpened>().empty())
        {
            CHECK(bench.TrySend(std::to_string(round)));
            CHECK_FALSE(bench.TrySend("next"));
        }
        REQUIRE(bench.recorder.GetRequests().size() == 1);
    }
    CHECK(sent["request"] >= 3);
    CHECK(sent["LR01"] >= 3);
    CHECK(sent["LR02"] >= 3);
}

TEST_CASE("9 Room that no durable request uses is given to the statuses")
{
    Fixture bench(MakeNarrowOptions());
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    CHECK_FALSE(bench.TrySend("b"));
    SendStatuses(bench, {"LR01", "LR02"});
    bench.Text(MakeAckText("PlanReport", "a"));
    const std::vector<AcsRequest> first = bench.recorder.GetRequests();
    REQUIRE(first.size() == 1);
    bench.Text(MakeAckText("RobotStatusUpdate", first[0].transactionID));
    CHECK(bench.recorder.GetEvents<Protocol::WindowOpened>().size() == 1);
    CHECK(bench.recorder.GetRequests().empty());
    bench.Timer(ESessionTimer::Ack, 5s);
    const std::vector<AcsRequest> second = bench.recorder.GetRequests();
    REQUIRE(second.size() == 1);
    CHECK(Describe(second[0]) == "LR02");
}

TEST_CASE("6 A status that changes while the states are sent after a connect does not delay the positions")
{
    Protocol::SessionOptions options;
    options.window = 1;
    Fixture bench(options);
    bench.StartAndRegister();
    SendStatuses(bench, {"LR01", "LR02"});
    bench.recorder.Clear();
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    const std::vector<AcsRequest> first = bench.recorder.GetRequests();
    REQUIRE(first.size() == 1);
    SendStatuses(bench, {"LR01"});
    const AcsRequest second = TakeTurn(bench, first[0]);
    CHECK(Describe(second) == "LR02");
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().size() == 1);
    CHECK(Describe(TakeTurn(bench, second)) == "LR01");
}

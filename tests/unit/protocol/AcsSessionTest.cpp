#include "AcsSessionFixture.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"

#include <chrono>
#include <limits>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::AcsRequest;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::EProtocolNote;
using Protocol::ESessionTimer;
using Fixture = Testing::AcsSessionFixture;
using Testing::MakeAckText;
using Testing::MakeOptions;
using Testing::MakeRequestText;
using Testing::MakeStatus;
using Strings = std::vector<std::string>;
using Notes = std::vector<EProtocolNote>;

TEST_CASE("1, 5 Registration is the first message, and nothing follows before its Ack")
{
    Fixture bench;
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetAll<Protocol::Connect>().size() == 1);
    CHECK_FALSE(bench.TrySend("a"));
    bench.recorder.Clear();
    bench.session.OnConnected(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetCommands() == Strings{"Registration"});
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Registration) == 5s);

    bench.recorder.Clear();
    CHECK_FALSE(bench.TrySend("a"));
    bench.session.SendStatus(Protocol::TscStateUpdate{}, bench.clock.GetNow(), bench.recorder.out);
    bench.session.SendPosition({}, bench.clock.GetNow(), bench.recorder.out);
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.out.empty());
    bench.Text(MakeRequestText("RequestAcsPlans", "{}"));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::BeforeRegistered});
    CHECK_FALSE(bench.session.IsRegistered());
}

TEST_CASE("6.2, D-4 The document's own RegistrationAck has another transactionId and counts")
{
    Fixture bench;
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnConnected(bench.clock.GetNow(), bench.recorder.out);
    bench.Text(Testing::ReadFixture("RegistrationAck"));
    CHECK(bench.session.IsRegistered());
    CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::AckMismatched});
}

TEST_CASE("6 After registration: replay, TSC state, comm state, each robot, then positions")
{
    Protocol::SessionOptions options;
    Fixture bench(options);
    const Core::Now now = bench.clock.GetNow();
    bench.session.SendStatus(MakeStatus("LR01", Protocol::ERobotStatus::Idle), now, bench.recorder.out);
    bench.session.SendStatus(MakeStatus("CR01", Protocol::ERobotStatus::Idle), now, bench.recorder.out);
    bench.session.SendStatus(Protocol::AcsCommStateUpdate{true}, now, bench.recorder.out);
    bench.session.SendStatus(Protocol::TscStateUpdate{}, now, bench.recorder.out);
    bench.StartAndRegister();
    CHECK(bench.recorder.GetCommands().empty());
    bench.recorder.Clear();
    REQUIRE(bench.TrySend("a"));
    REQUIRE(bench.TrySend("b"));
    bench.session.ReplayDone(now, bench.recorder.out);
    CHECK(
        bench.recorder.GetCommands()
        == Strings{
            "PlanReport",
            "PlanReport",
            "TscStateUpdate",
            "AcsCommStateUpdate",
            "RobotStatusUpdate",
            "RobotStatusUpdate"});
    CHECK(std::holds_alternative<Protocol::PositionDue>(std::get<Protocol::Deliver>(bench.recorder.out.back()).event));
}

TEST_CASE("6 While the replay fills the window, positions wait for the states as these wait for room")
{
    Protocol::SessionOptions options;
    options.window = 2;
    Fixture bench(options);
    const Core::Now now = bench.clock.GetNow();
    bench.session.SendStatus(Protocol::TscStateUpdate{}, now, bench.recorder.out);
    bench.session.SendStatus(MakeStatus("LR01", Protocol::ERobotStatus::Idle), now, bench.recorder.out);
    bench.StartAndRegister();
    REQUIRE(bench.TrySend("a"));
    REQUIRE(bench.TrySend("b"));
    bench.recorder.Clear();
    bench.session.ReplayDone(now, bench.recorder.out);
    bench.session.SendPosition({}, now, bench.recorder.out);
    CHECK(bench.recorder.GetCommands().empty());
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().empty());

    bench.Text(MakeAckText("PlanReport", "a"));
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().empty());

    bench.Text(MakeAckText("PlanReport", "b"));
    CHECK(bench.recorder.GetCommands() == Strings{"RobotStatusUpdate"});
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().size() == 1);
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Position) == 200ms);
}

TEST_CASE("9 A durable request keeps the caller's transactionId and timestamp on every connection")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    const std::string first = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    bench.Closed();
    CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().at(0).bWasRegistered);
    bench.Timer(ESessionTimer::Reconnect, 10s);
    CHECK(bench.recorder.GetAll<Protocol::Connect>().size() == 1);
    bench.Register();
    bench.recorder.Clear();
    REQUIRE(bench.TrySend("a"));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == first);
    bench.Text(MakeAckText("PlanReport", "a"));
    CHECK(
        bench.recorder.GetEvents<Protocol::Acked>()
        == std::vector<Protocol::Acked>{{EAcsCommand::PlanReport, "a", EAckResult::Success, ""}});
}

TEST_CASE("9 Without an Ack the same text is sent again three times, then the request expires")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    const std::string first = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Ack) == 5s);
    for (int round = 0; round < 3; ++round)
    {
        bench.Timer(ESessionTimer::Ack, 5s);
        REQUIRE(bench.recorder.GetAll<Protocol::SendText>().size() == 1);
        CHECK(bench.recorder.GetAll<Protocol::SendText>()[0].text == first);
    }
    bench.Timer(ESessionTimer::Ack, 5s);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetEvents<Protocol::RequestUnanswered>().at(0).transactionID == "a");
    CHECK(bench.recorder.GetAll<Protocol::Close>().empty());

    SECTION("an Ack that comes too late still counts, once")
    {
        bench.Text(MakeAckText("PlanReport", "a"));
        CHECK(bench.recorder.GetEvents<Protocol::Acked>().size() == 1);
        bench.Text(MakeAckText("PlanReport", "a"));
        CHECK(bench.recorder.GetEvents<Protocol::Acked>().empty());
    }
}

TEST_CASE("9 Five expired requests in a row drop the link, and the session reconnects")
{
    Protocol::SessionOptions options = MakeOptions();
    options.ackRetries = 0;
    Fixture bench(options);
    bench.StartAndReplay();
    for (const std::string transactionID : {"a", "b", "c", "d"})
    {
        REQUIRE(bench.TrySend(transactionID));
    }
    bench.Timer(ESessionTimer::Ack, 5s);
    CHECK(bench.recorder.GetAll<Protocol::Close>().empty());
    SECTION("an Ack in between starts the count again")
    {
        REQUIRE(bench.TrySend("e"));
        bench.Text(MakeAckText("PlanReport", "e"));
        REQUIRE(bench.TrySend("f"));
        bench.Timer(ESessionTimer::Ack, 5s);
        CHECK(bench.recorder.GetAll<Protocol::Close>().empty());
    }
    SECTION("the fifth closes")
    {
        REQUIRE(bench.TrySend("e"));
        bench.Timer(ESessionTimer::Ack, 5s);
        CHECK(bench.recorder.GetAll<Protocol::Close>().size() == 1);
        CHECK_FALSE(bench.session.IsRegistered());
        CHECK_FALSE(bench.TrySend("g"));
        bench.Closed();
        CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().at(0).bWasRegistered);
        CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Reconnect).has_value());
    }
}

TEST_CASE("9 A status that a newer one has replaced is not sent again")
{
    Fixture bench;
    bench.StartAndReplay();
    const Core::Now now = bench.clock.GetNow();
    bench.session.SendStatus(MakeStatus("LR01", Protocol::ERobotStatus::Moving), now, bench.recorder.out);
    bench.session.SendStatus(MakeStatus("LR01", Protocol::ERobotStatus::Arrival), now, bench.recorder.out);
    CHECK(bench.recorder.GetRequests().size() == 2);
    bench.Timer(ESessionTimer::Ack, 5s);
    const std::vector<AcsRequest> requests = bench.recorder.GetRequests();
    REQUIRE(requests.size() == 1);
    CHECK(std::get<Protocol::RobotStatusUpdate>(requests[0].payload).robotStatus == Protocol::ERobotStatus::Arrival);
}

TEST_CASE("9 Every connection begins with the present status of every robot")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.session.SendStatus(
        MakeStatus("LR01", Protocol::ERobotStatus::Idle),
        bench.clock.GetNow(),
        bench.recorder.out);
    bench.AckAllRequests();
    bench.Closed();
    bench.session.SendStatus(
        MakeStatus("LR01", Protocol::ERobotStatus::Error),
        bench.clock.GetNow(),
        bench.recorder.out);
    bench.Timer(ESessionTimer::Reconnect, 10s);
    bench.Register();
    bench.recorder.Clear();
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    const std::vector<AcsRequest> requests = bench.recorder.GetRequests();
    REQUIRE(requests.size() == 1);
    CHECK(std::get<Protocol::RobotStatusUpdate>(requests[0].payload).robotStatus == Protocol::ERobotStatus::Error);
}

TEST_CASE("D-4 The second Ack of a message that was sent twice does not acknowledge another one")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    bench.Timer(ESessionTimer::Ack, 5s);
    REQUIRE(bench.TrySend("b"));
    bench.Text(MakeAckText("PlanReport", "a"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "a");
    bench.Text(MakeAckText("PlanReport", "a"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().empty());
    bench.Text(MakeAckText("PlanReport", "b"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "b");
}

TEST_CASE("D-4 The late Ack of an abandoned request is known after many other Acks")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    for (int attempt = 0; attempt < 4; ++attempt)
    {
        bench.Timer(ESessionTimer::Ack, 5s);
    }
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestUnanswered>().size() == 1);
    for (int count = 0; count < 200; ++count)
    {
        REQUIRE(bench.TrySend(std::to_string(count)));
        bench.Text(MakeAckText("PlanReport", std::to_string(count)));
    }
    REQUIRE(bench.TrySend("b"));
    bench.Text(MakeAckText("PlanReport", "a"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "a");
    bench.Text(MakeAckText("PlanReport", "b"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "b");
}

TEST_CASE("D-4 With mcs.ack_match id an Ack with a foreign transactionId is ignored, also for the registration")
{
    Protocol::SessionOptions options;
    options.bAcksMatchedByCommand = false;
    Fixture bench(options);
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnConnected(bench.clock.GetNow(), bench.recorder.out);
    bench.Text(Testing::ReadFixture("RegistrationAck"));
    CHECK_FALSE(bench.session.IsRegistered());
    CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::AckUnexpected});

    Fixture other(options);
    other.StartAndReplay();
    REQUIRE(other.TrySend("a"));
    other.Text(MakeAckText("PlanReport", "foreign"));
    CHECK(other.recorder.GetEvents<Protocol::Acked>().empty());
    CHECK(other.session.GetStatistics().CountOf(EProtocolNote::AckUnexpected) == 1);
    other.Text(MakeAckText("PlanReport", "a"));
    CHECK(other.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "a");
}

TEST_CASE("9 An Ack with Fail is final")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    bench.Text(MakeAckText("PlanReport", "a", "Fail"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).result == EAckResult::Fail);
    bench.Timer(ESessionTimer::Ack, 5s);
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("1 Reconnects indefinitely, at growing intervals up to ten seconds, at once after a success")
{
    Fixture bench;
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    std::chrono::milliseconds last{0};
    for (int attempt = 0; attempt < 20; ++attempt)
    {
        bench.Closed();
        CHECK_FALSE(bench.recorder.GetEvents<Protocol::LinkLost>().at(0).bWasRegistered);
        last = bench.recorder.GetDelayOrNull(ESessionTimer::Reconnect).value_or(0ms);
        CHECK(last > 0ms);
        CHECK(last <= 10s);
        bench.Timer(ESessionTimer::Reconnect, last);
        REQUIRE(bench.recorder.GetAll<Protocol::Connect>().size() == 1);
    }
    CHECK(last >= 5s);
    bench.Register();
    bench.Closed();
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Reconnect).value_or(1h) <= 500ms);
}

TEST_CASE("1 A rejected or unanswered registration is tried again")
{
    Fixture bench;
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnConnected(bench.clock.GetNow(), bench.recorder.out);
    SECTION("refused")
    {
        bench.Text(MakeAckText("Registration", "any", "Fail"));
        CHECK(bench.recorder.GetEvents<Protocol::RegistrationRefused>().size() == 1);
    }
    SECTION("unanswered")
    {
        bench.Timer(ESessionTimer::Registration, 5s);
        CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::RegistrationUnanswered});
    }
    CHECK(bench.recorder.GetAll<Protocol::Close>().size() == 1);
    bench.Closed();
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Reconnect).has_value());
}

TEST_CASE("1 Stop sends isConnected=false, waits a limited time for the Ack, and closes with 1000")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.recorder.Clear();
    bench.session.Stop(bench.clock.GetNow(), bench.recorder.out);
    const std::vector<AcsRequest> requests = bench.recorder.GetRequests();
    REQUIRE(requests.size() == 1);
    CHECK(requests[0].payload == Protocol::AcsPayload(Protocol::AcsCommStateUpdate{false}));
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Shutdown) == 2s);
    CHECK_FALSE(bench.TrySend("a"));
    SECTION("acknowledged")
    {
        bench.Text(MakeAckText("AcsCommStateUpdate", requests[0].transactionID));
    }
    SECTION("not acknowledged")
    {
        bench.Timer(ESessionTimer::Shutdown, 2s);
    }
    REQUIRE(bench.recorder.GetAll<Protocol::Close>().size() == 1);
    CHECK(bench.recorder.GetAll<Protocol::Close>()[0].code == 1000);
    bench.Closed();
    CHECK(bench.recorder.GetEvents<Protocol::Stopped>().size() == 1);
    CHECK_FALSE(bench.recorder.GetDelayOrNull(ESessionTimer::Reconnect).has_value());
    bench.Timer(ESessionTimer::Reconnect, 10s);
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("6.21 After isConnected=false an older isConnected=true is not sent again")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.session.SendStatus(Protocol::AcsCommStateUpdate{true}, bench.clock.GetNow(), bench.recorder.out);
    bench.clock.Advance(4s);
    bench.session.Stop(bench.clock.GetNow(), bench.recorder.out);
    bench.Timer(ESessionTimer::Ack, 1s);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
}

TEST_CASE("1 Stop between two attempts ends at once, and Start begins again")
{
    Fixture bench;
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    bench.Closed();
    bench.recorder.Clear();
    bench.session.Stop(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetEvents<Protocol::Stopped>().size() == 1);
    CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().size() == 1);
    bench.StartAndRegister();
}

TEST_CASE("R14 Positions are due every 200 ms without drift, are never queued and expect no Ack")
{
    Protocol::SessionOptions options;
    Fixture bench(options);
    bench.StartAndReplay();
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().size() == 1);
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Position) == 200ms);
    bench.Timer(ESessionTimer::Position, 230ms);
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Position) == 170ms);
    bench.Timer(ESessionTimer::Position, 1000ms); // at 1230: the ticks at 400 to 1200 are one
    CHECK(bench.session.GetStatistics().positionTicksMissed == 4);
    CHECK(bench.recorder.GetEvents<Protocol::PositionDue>().size() == 1);
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Position) == 170ms);

    bench.recorder.Clear();
    bench.session.SendPosition({{{"LR01", 1.5, 2.0, 90.0, 75.0}}}, bench.clock.GetNow(), bench.recorder.out);
    REQUIRE(bench.recorder.out.size() == 1);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).bDroppable);
    CHECK(bench.session.GetRoom() == 16);
    bench.Closed();
    CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().size() == 1);
    bench.recorder.Clear();
    bench.session.SendPosition({}, bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("R14 A robot without a finite position is left out of the positions")
{
    const double noNumber =
        GENERATE(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity());
    const Protocol::RobotPosition robot = GENERATE_COPY(
        Protocol::RobotPosition{"LR02", noNumber, 2.0, 90.0, 75.0},
        Protocol::RobotPosition{"LR02", 1.5, noNumber, 90.0, 75.0},
        Protocol::RobotPosition{"LR02", 1.5, 2.0, noNumber, 75.0},
        Protocol::RobotPosition{"LR02", 1.5, 2.0, 90.0, noNumber});
    Fixture bench(Protocol::SessionOptions{});
    bench.StartAndReplay();
    bench.recorder.Clear();
    const Protocol::RobotPosition other{"LR01", 1.5, 2.0, 90.0, 75.0};
    bench.session.SendPosition({{robot, other}}, bench.clock.GetNow(), bench.recorder.out);
    const auto sent = bench.recorder.GetRequests();
    REQUIRE(sent.size() == 1);
    CHECK(std::get<Protocol::RobotPositionUpdate>(sent[0].payload) == Protocol::RobotPositionUpdate{{other}});
    bench.recorder.Clear();
    bench.session.SendPosition({{robot}}, bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("R15 The TSC state is sent once after connecting, then on change")
{
    Fixture bench;
    bench.session.SendStatus(Protocol::TscStateUpdate{}, bench.clock.GetNow(), bench.recorder.out);
    bench.StartAndReplay();
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
    bench.AckAllRequests();
    bench.recorder.Clear();
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.out.empty());
    bench.session.SendStatus(
        Protocol::TscStateUpdate{Protocol::ETscState::Pausing},
        bench.clock.GetNow(),
        bench.recorder.out);
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
}

TEST_CASE("9 A jump of the wall clock changes no deadline")
{
    Fixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    bench.clock.JumpWall(-3h);
    bench.Timer(ESessionTimer::Ack, 4999ms);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Ack) == 1ms);
    bench.Timer(ESessionTimer::Ack, 1ms);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().size() == 1);
}

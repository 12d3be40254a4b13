#include "AcsSessionFixture.hpp"
#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/McsSession.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

// Rules R1 to R3 and R13 to R19 of section 8 and vectors 1, 5 and 9 of section 13 for both sessions, in virtual time.
// R17 for each form of a location is in LocationTest, R18 for a whole plan in AcsCodecTest.

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::AcsRequest;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::EProtocolNote;
using Protocol::ESessionTimer;
using Testing::AcsSessionFixture;
using Testing::MakeAckText;
using Testing::MakeRequestText;
using Testing::ReadFixture;
using Strings = std::vector<std::string>;

namespace
{

std::vector<EAcsCommand> ListCommands(bool bSentByMCS)
{
    std::vector<EAcsCommand> commands;
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<EAcsCommand>(index);
        if (IsSentByMCS(command) == bSentByMCS)
        {
            commands.push_back(command);
        }
    }
    return commands;
}

/// The golden file of a command under a transactionId of its own.
std::string ReadRequest(EAcsCommand command, const std::string& transactionID)
{
    std::string text = ReadFixture("golden/" + std::string(GetText(command)) + ".minimal");
    const std::string usual = R"("transactionId":"t")";
    return text.replace(text.find(usual), usual.size(), R"("transactionId":")" + transactionID + '"');
}

class McsSide
{
public:
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::McsSession session;
    Testing::ActionRecorder recorder;

    explicit McsSide(const Protocol::McsSessionOptions& options = {})
        : session(options, random)
    {
        Connect(1);
    }

    void Connect(Protocol::ConnectionID connection)
    {
        session.OnConnected(connection, clock.GetNow(), recorder.out);
        Text(MakeRequestText("Registration", "{}", "r-" + std::to_string(connection)), connection);
        REQUIRE(session.IsRegistered());
    }

    void Text(const std::string& text, Protocol::ConnectionID connection = 1)
    {
        recorder.Clear();
        session.OnText(connection, text, clock.GetNow(), recorder.out);
    }

    [[nodiscard]] bool TrySend(Protocol::AcsPayload payload)
    {
        recorder.Clear();
        const AcsRequest request = session.MakeRequest(std::move(payload), clock.GetNow());
        return session.TrySend(request, clock.GetNow(), recorder.out);
    }

    void SendCommState(bool bConnected, const std::string& transactionID)
    {
        const std::string state = bConnected ? "true" : "false";
        Text(MakeRequestText("AcsCommStateUpdate", R"({"isConnected":)" + state + "}", transactionID));
    }
};

Protocol::ExecutionPlan MakePlan()
{
    return {"P", "L", {}, {{1, "Start", "A01.SET01", {}, {}}}};
}

} // namespace

TEST_CASE("R1, R2 The ACS answers every request of the MCS once, feasible or not, with its transactionId")
{
    AcsSessionFixture bench;
    bench.StartAndReplay();
    bool bFeasible = false;
    for (const EAcsCommand command : ListCommands(true))
    {
        INFO(GetText(command));
        const std::string transactionID = "t-" + std::string(GetText(command));
        bench.Text(ReadRequest(command, transactionID));
        const auto received = bench.recorder.GetEvents<Protocol::RequestReceived>();
        REQUIRE(received.size() == 1);
        CHECK(GetCommand(received[0].request) == command);
        CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());

        bench.recorder.Clear();
        const EAckResult result = bFeasible ? EAckResult::Success : EAckResult::Fail;
        bench.session.Answer(command, transactionID, result, "as judged", {}, bench.clock.GetNow(), bench.recorder.out);
        const std::vector<Protocol::AcsAck> acks = bench.recorder.GetAcks();
        REQUIRE(acks.size() == 1);
        CHECK(acks[0].command == command);
        CHECK(acks[0].transactionID == transactionID);
        CHECK(acks[0].result == result);
        CHECK(bench.session.GetStatistics().Of(command).acknowledged == 1);
        bFeasible = !bFeasible;
    }
}

TEST_CASE("R1, R2 The MCS acknowledges every report of the ACS at once with its transactionId, except positions")
{
    McsSide side;
    for (const EAcsCommand command : ListCommands(false))
    {
        INFO(GetText(command));
        const std::string transactionID = "t-" + std::string(GetText(command));
        side.Text(ReadRequest(command, transactionID));
        if (command != EAcsCommand::Registration)
        {
            CHECK(side.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
        }
        const std::vector<Protocol::AcsAck> acks = side.recorder.GetAcks();
        if (command == EAcsCommand::RobotPositionUpdate)
        {
            CHECK(acks.empty());
            continue;
        }
        REQUIRE(acks.size() == 1);
        CHECK(acks[0].command == command);
        CHECK(acks[0].transactionID == transactionID);
        CHECK(acks[0].result == EAckResult::Success);
    }
}

TEST_CASE("R3 Either side answers an undefined payload with Fail, whatever the command")
{
    for (const std::string payload : {"null", "[]", "7", R"("x")"})
    {
        for (const bool bSentByMCS : {true, false})
        {
            AcsSessionFixture bench;
            bench.StartAndReplay();
            McsSide side;
            for (const EAcsCommand command : ListCommands(bSentByMCS))
            {
                INFO(GetText(command) << " " << payload);
                const std::string text = MakeRequestText(std::string(GetText(command)), payload, "bad");
                bench.Text(text);
                side.Text(text);
                Testing::ActionRecorder& recorder = bSentByMCS ? bench.recorder : side.recorder;
                CHECK(recorder.GetEvents<Protocol::RequestReceived>().empty());
                if (!HasAck(command))
                {
                    CHECK(recorder.GetAll<Protocol::SendText>().empty());
                    continue;
                }
                const std::vector<Protocol::AcsAck> acks = recorder.GetAcks();
                REQUIRE(acks.size() == 1);
                CHECK(acks[0].command == command);
                CHECK(acks[0].transactionID == "bad");
                CHECK(acks[0].result == EAckResult::Fail);
                CHECK(acks[0].message.find("payload: expected an object") == 0);
            }
        }
    }
}

TEST_CASE("R13 The ACS sends an empty port as null, and the MCS delivers it as absent")
{
    AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.recorder.Clear();
    Protocol::RobotStatusUpdate status;
    status.robotID = "CR01";
    status.robotType = Protocol::ERobotType::Control;
    status.carrierIDs = {std::nullopt, "TRAY_02", std::nullopt};
    bench.session.SendStatus(status, bench.clock.GetNow(), bench.recorder.out);
    const std::string text = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    CHECK(text.find(R"("carrierIds":[null,"TRAY_02",null])") != std::string::npos);
    McsSide side;
    side.Text(text);
    const AcsRequest received = side.recorder.GetEvents<Protocol::RequestReceived>().at(0).request;
    CHECK(received.payload == Protocol::AcsPayload(status));
}

TEST_CASE("R14 Ten thousand positions are due exactly 200 ms apart, however late each timer is")
{
    AcsSessionFixture bench{Protocol::SessionOptions{}};
    bench.StartAndReplay();
    const Core::SteadyTime start = bench.clock.GetNow().steady;
    std::chrono::milliseconds late{0};
    for (int tick = 1; tick <= 10'000; ++tick)
    {
        const auto delayOrNull = bench.recorder.GetDelayOrNull(ESessionTimer::Position);
        REQUIRE(delayOrNull.has_value());
        // The timer is set to the tick itself, not to 200 ms after the last one, which was late.
        REQUIRE(bench.clock.GetNow().steady + *delayOrNull == start + tick * 200ms);
        late = (late + 37ms) % 199;
        bench.Timer(ESessionTimer::Position, *delayOrNull + late);
        REQUIRE(bench.recorder.GetEvents<Protocol::PositionDue>().size() == 1);
    }
}

TEST_CASE("R14 A position has no Ack: it takes no room, is not sent again, and an Ack for it is unexpected")
{
    AcsSessionFixture bench{Protocol::SessionOptions{}};
    bench.StartAndReplay();
    bench.recorder.Clear();
    bench.session.SendPosition({{{"LR01", 1.0, 2.0, 90.0, 75.0}}}, bench.clock.GetNow(), bench.recorder.out);
    REQUIRE(bench.recorder.GetRequests().size() == 1);
    const std::string transactionID = bench.recorder.GetRequests()[0].transactionID;
    CHECK_FALSE(bench.recorder.GetDelayOrNull(ESessionTimer::Ack).has_value());
    CHECK(bench.session.GetRoom() == 16);
    bench.Timer(ESessionTimer::Ack, 30s);
    CHECK(bench.recorder.out.empty());
    bench.Text(MakeAckText("RobotPositionUpdate", transactionID));
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckUnexpected});
}

TEST_CASE("R15 The TSC state is sent once on each connection and on each change, not when it is set again")
{
    AcsSessionFixture bench;
    const auto set = [&bench](Protocol::ETscState state) {
        bench.recorder.Clear();
        bench.session.SendStatus(Protocol::TscStateUpdate{state}, bench.clock.GetNow(), bench.recorder.out);
        return bench.recorder.GetCommands().size();
    };
    CHECK(set(Protocol::ETscState::Auto) == 0);
    bench.StartAndReplay();
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
    CHECK(set(Protocol::ETscState::Auto) == 0);
    CHECK(set(Protocol::ETscState::Pausing) == 1);
    CHECK(set(Protocol::ETscState::Pausing) == 0);
    CHECK(set(Protocol::ETscState::Auto) == 1);
    bench.Closed();
    bench.Timer(ESessionTimer::Reconnect, 10s);
    bench.Register();
    bench.recorder.Clear();
    bench.session.ReplayDone(bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
}

TEST_CASE("R15 A TSC state that the MCS never acknowledged is sent when it is set again")
{
    Protocol::SessionOptions options = Testing::MakeOptions();
    options.ackRetries = 0;
    AcsSessionFixture bench(options);
    bench.session.SendStatus(Protocol::TscStateUpdate{}, bench.clock.GetNow(), bench.recorder.out);
    bench.StartAndReplay();
    bench.Timer(ESessionTimer::Ack, 5s);
    bench.recorder.Clear();
    bench.session.SendStatus(Protocol::TscStateUpdate{}, bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.GetCommands() == Strings{"TscStateUpdate"});
}

TEST_CASE("R16 While isConnected is false the MCS keeps its plans, and nothing but its plans")
{
    McsSide side;
    CHECK(side.session.IsTakingPlans());
    CHECK(side.TrySend(MakePlan()));
    side.SendCommState(false, "c-1");
    CHECK_FALSE(side.session.IsTakingPlans());
    CHECK_FALSE(side.TrySend(MakePlan()));
    CHECK(side.recorder.out.empty());
    CHECK(side.TrySend(Protocol::CancelPlan{"P", ""}));
    CHECK(side.TrySend(Protocol::RequestAcsPlans{}));
    SECTION("until it is true")
    {
        side.SendCommState(true, "c-2");
        CHECK(side.TrySend(MakePlan()));
        side.SendCommState(false, "c-1"); // the first one once more, late
        CHECK(side.TrySend(MakePlan()));
    }
    SECTION("or the ACS registers again")
    {
        side.session.OnClosed(1, "gone", side.clock.GetNow(), side.recorder.out);
        CHECK_FALSE(side.session.IsTakingPlans());
        side.Connect(2);
        CHECK(side.TrySend(MakePlan()));
    }
}

TEST_CASE("R16 By option the MCS ignores isConnected")
{
    Protocol::McsSessionOptions options;
    options.bPlansWithheld = false;
    McsSide side(options);
    side.SendCommState(false, "c-1");
    CHECK(side.TrySend(MakePlan()));
    CHECK_FALSE(side.session.IsTakingPlans());
}

TEST_CASE("R18 The MCS sends MemoryPickAndPlace with empty carrierIds, and the ACS delivers it so")
{
    McsSide side;
    Protocol::ExecutionPlan plan = MakePlan();
    plan.steps = {{1, "MemoryPickAndPlace", "A01.SET01", {}, {{"J", "AMR.TP01.MP01", "A01.SET01.MP01"}}}};
    REQUIRE(side.TrySend(plan));
    const std::string text = side.recorder.GetAll<Protocol::SendText>().at(0).text;
    CHECK(text.find(R"("carrierIds":[])") != std::string::npos);
    AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.Text(text);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().at(0).request.payload == Protocol::AcsPayload(plan));
}

TEST_CASE("R19 Both sessions send timestamps in the site's local time with offset, also after the offset has changed")
{
    Protocol::SessionOptions options = Testing::MakeOptions();
    options.codec.siteOffset = 9h;
    AcsSessionFixture bench(options); // its clock is at 12:00 UTC
    const auto hasStamp = [](const Testing::ActionRecorder& recorder, const std::string& stamp) {
        const std::string text = recorder.GetAll<Protocol::SendText>().at(0).text;
        return text.find(R"("timestamp":")" + stamp + '"') != std::string::npos;
    };
    bench.session.Start(bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnConnected(bench.clock.GetNow(), bench.recorder.out);
    CHECK(hasStamp(bench.recorder, "2025-07-02T21:00:00.000+09:00"));
    bench.Text(MakeAckText("Registration", "any"));
    bench.session.SetSiteOffset(-210min);
    bench.clock.Advance(17ms);
    bench.Text(MakeRequestText("Dance", "{}"));
    CHECK(hasStamp(bench.recorder, "2025-07-02T08:30:00.017-03:30"));

    Protocol::McsSessionOptions mcsOptions;
    mcsOptions.codec.siteOffset = 9h;
    McsSide side(mcsOptions);
    CHECK(hasStamp(side.recorder, "2025-07-02T21:00:00.000+09:00"));
    side.session.SetSiteOffset(0min);
    REQUIRE(side.TrySend(Protocol::RequestAcsPlans{}));
    CHECK(hasStamp(side.recorder, "2025-07-02T12:00:00.000+00:00"));
}

TEST_CASE("13.1 A request with result and message null and escapes in its time is delivered and acknowledged")
{
    AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.Text(
        "{\"command\":\"CancelPlan\",\"transactionId\":\"t-1\",\"timestamp\":\"2025-07-02T21:00:00.1234567\\u002B09:00\","
        "\"result\":null,\"message\":null,\"payload\":{\"planId\":\"P\",\"reason\":null}}");
    const auto received = bench.recorder.GetEvents<Protocol::RequestReceived>();
    REQUIRE(received.size() == 1);
    CHECK(received[0].request.payload == Protocol::AcsPayload(Protocol::CancelPlan{"P", ""}));
    CHECK(received[0].request.timestamp == Core::Timestamp{Core::WallTime(1'751'457'600'123ms), 9h});
    bench.recorder.Clear();
    bench.session.Answer(
        EAcsCommand::CancelPlan,
        "t-1",
        EAckResult::Success,
        "",
        Protocol::PlanAck{"P"},
        bench.clock.GetNow(),
        bench.recorder.out);
    CHECK(bench.recorder.GetAcks().at(0).transactionID == "t-1");
}

TEST_CASE("13.5 The same plan with a new transactionId is a new request, which the receiver rejects")
{
    AcsSessionFixture bench;
    bench.StartAndReplay();
    const std::string payload = R"({"planId":"P","steps":[{"stepNo":1,"action":"Start","position":"A01.SET01"}]})";
    const auto answer = [&bench](const std::string& transactionID, EAckResult result) {
        bench.recorder.Clear();
        bench.session.Answer(
            EAcsCommand::ExecutionPlan,
            transactionID,
            result,
            "",
            Protocol::PlanAck{"P"},
            bench.clock.GetNow(),
            bench.recorder.out);
        return bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    };
    bench.Text(MakeRequestText("ExecutionPlan", payload, "t-1"));
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    const std::string first = answer("t-1", EAckResult::Success);

    bench.clock.Advance(3s);
    bench.Text(MakeRequestText("ExecutionPlan", payload, "t-1"));
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == first);

    bench.Text(MakeRequestText("ExecutionPlan", payload, "t-2"));
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    CHECK(answer("t-2", EAckResult::Fail).find(R"("transactionId":"t-2")") != std::string::npos);
    const Protocol::CommandCounters& counters = bench.session.GetStatistics().Of(EAcsCommand::ExecutionPlan);
    CHECK(counters.received == 3);
    CHECK(counters.duplicates == 1);
    CHECK(counters.refused == 1);
}

TEST_CASE("D-23 The kept Acks are limited in bytes: those of queries are dropped before those of executed requests")
{
    Protocol::SessionOptions options;
    options.answerBytes = 10'000;
    AcsSessionFixture bench(options);
    bench.StartAndReplay();
    const auto answer = [&bench](EAcsCommand command, const std::string& id, const Protocol::AckPayload& payload) {
        const std::string message(3'000, 'x');
        bench.session
            .Answer(command, id, EAckResult::Success, message, payload, bench.clock.GetNow(), bench.recorder.out);
    };
    const std::string cancel = MakeRequestText("CancelPlan", R"({"planId":"P"})", "c");
    bench.Text(cancel);
    answer(EAcsCommand::CancelPlan, "c", Protocol::PlanAck{"P"});
    for (int i = 0; i < 20; ++i)
    {
        const std::string id = "q" + std::to_string(i);
        bench.Text(MakeRequestText("RequestAcsErrorList", "{}", id));
        REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
        answer(EAcsCommand::RequestAcsErrorList, id, Protocol::ErrorListAck{});
    }
    bench.Text(cancel);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.recorder.GetAll<Protocol::SendText>().size() == 1);
    bench.Text(MakeRequestText("RequestAcsErrorList", "{}", "q19"));
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    bench.Text(MakeRequestText("RequestAcsErrorList", "{}", "q0"));
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
}

TEST_CASE("D-23 The kept Acks are limited in number: those of queries are dropped before those of executed requests")
{
    Protocol::SessionOptions options;
    options.answerCount = 4;
    AcsSessionFixture bench(options);
    bench.StartAndReplay();
    const auto ask = [&bench](EAcsCommand command, const std::string& text, const std::string& id) {
        bench.Text(text);
        const std::size_t delivered = bench.recorder.GetEvents<Protocol::RequestReceived>().size();
        if (delivered > 0)
        {
            bench.session.Answer(
                command,
                id,
                EAckResult::Success,
                "",
                Protocol::EmptyAck{},
                bench.clock.GetNow(),
                bench.recorder.out);
        }
        return delivered;
    };
    const std::string cancel = MakeRequestText("CancelPlan", R"({"planId":"P"})", "c");
    CHECK(ask(EAcsCommand::CancelPlan, cancel, "c") == 1);
    for (int i = 0; i < 6; ++i)
    {
        const std::string id = "q" + std::to_string(i);
        CHECK(ask(EAcsCommand::RequestAcsErrorList, MakeRequestText("RequestAcsErrorList", "{}", id), id) == 1);
    }
    CHECK(ask(EAcsCommand::CancelPlan, cancel, "c") == 0);
    CHECK(ask(EAcsCommand::RequestAcsErrorList, MakeRequestText("RequestAcsErrorList", "{}", "q5"), "q5") == 0);
    CHECK(ask(EAcsCommand::RequestAcsErrorList, MakeRequestText("RequestAcsErrorList", "{}", "q0"), "q0") == 1);
}

TEST_CASE("13.9 An Ack with a wrong transactionId counts for the oldest request of its command, on either side")
{
    AcsSessionFixture bench;
    bench.StartAndReplay();
    REQUIRE(bench.TrySend("a"));
    REQUIRE(bench.TrySend("b"));
    bench.Text(MakeAckText("PlanReport", "wrong"));
    CHECK(bench.recorder.GetEvents<Protocol::Acked>().at(0).transactionID == "a");
    CHECK(bench.session.GetStatistics().CountOf(EProtocolNote::AckMismatched) == 1);
    bench.Text(MakeAckText("StepReport", "wrong"));
    CHECK(bench.session.GetStatistics().CountOf(EProtocolNote::AckUnexpected) == 1);

    McsSide side;
    REQUIRE(side.TrySend(Protocol::CancelPlan{"P", ""}));
    const std::string first = side.recorder.GetRequests().at(0).transactionID;
    REQUIRE(side.TrySend(Protocol::CancelPlan{"Q", ""}));
    side.Text(MakeAckText("CancelPlan", "wrong"));
    CHECK(side.recorder.GetEvents<Protocol::AckReceived>().at(0).ack.transactionID == first);
    CHECK(side.session.GetStatistics().CountOf(EProtocolNote::AckMismatched) == 1);
}

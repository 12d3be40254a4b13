#include "wire/SimulatedMcsSession.hpp"

#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using McsSim::McsBehaviour;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::EProtocolNote;
using Testing::MakeRequestText;

namespace
{

const std::string PLAN_REPORT = R"({"planId":"P","status":"Completed","message":""})";

class SimulatedMcsFixture
{
public:
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Testing::ActionRecorder probe;
    std::optional<std::chrono::milliseconds> delay; ///< The last one requested.
    McsSim::SimulatedMcsSession session;

    explicit SimulatedMcsFixture(const McsBehaviour& behaviour = {}, const Protocol::McsSessionOptions& options = {})
        : session(options, behaviour, random, [this](std::chrono::milliseconds requested) { delay = requested; })
    {
    }

    void Text(Protocol::ConnectionID connection, const std::string& text)
    {
        probe.Clear();
        session.OnText(connection, text, clock.GetNow(), probe.out);
    }

    void Register(Protocol::ConnectionID connection)
    {
        session.OnConnected(connection, clock.GetNow(), probe.out);
        Text(connection, MakeRequestText("Registration", "{}", "r-" + std::to_string(connection)));
    }

    void SendDelayed()
    {
        probe.Clear();
        delay.reset();
        session.SendDelayed(clock.GetNow(), probe.out);
    }
};

} // namespace

TEST_CASE("12.3 A registration whose Ack is delayed replaces one in between, or is refused by option")
{
    const bool bSecondRefused = GENERATE(false, true);
    Protocol::McsSessionOptions options;
    options.bSecondRefused = bSecondRefused;
    SimulatedMcsFixture mcs({}, options);
    mcs.session.HoldAcks({EAcsCommand::Registration, 2s, 1s}, mcs.clock.GetNow());
    mcs.Register(1);
    mcs.clock.Advance(1500ms);
    mcs.Register(2);
    CHECK(mcs.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
    mcs.clock.Advance(500ms);
    mcs.SendDelayed();
    CHECK(mcs.session.GetRegisteredOrNull() == Protocol::ConnectionID(bSecondRefused ? 2 : 1));
    const auto closes = mcs.probe.GetAll<Protocol::Close>();
    REQUIRE(closes.size() == 1);
    CHECK(closes[0].connection == Protocol::ConnectionID(bSecondRefused ? 1 : 2));
    CHECK(mcs.probe.GetEvents<Protocol::LinkLost>().size() == (bSecondRefused ? 0U : 1U));
}

TEST_CASE("A withheld Ack is never sent; the report is delivered, and its repetition is answered")
{
    SimulatedMcsFixture mcs;
    mcs.Register(1);
    mcs.session.HoldAcks({EAcsCommand::PlanReport, std::nullopt, 6s}, mcs.clock.GetNow());
    mcs.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
    CHECK(mcs.probe.GetEvents<Protocol::RequestReceived>().size() == 1);
    CHECK(mcs.session.GetStatistics().Of(EAcsCommand::PlanReport).acknowledged == 0);
    mcs.Text(1, MakeRequestText("TscStateUpdate", R"({"state":"Auto"})", "b"));
    CHECK(mcs.probe.GetAcks().size() == 1);
    mcs.clock.Advance(6s);
    mcs.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(mcs.probe.GetAcks().size() == 1);
    CHECK(mcs.probe.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
}

TEST_CASE("A delayed Ack is sent at its time, unless its connection was closed before")
{
    SimulatedMcsFixture mcs;
    mcs.Register(1);
    mcs.session.HoldAcks({std::nullopt, 2s, 10s}, mcs.clock.GetNow());
    mcs.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
    CHECK(mcs.delay == 2s);
    mcs.clock.Advance(1s);
    mcs.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "b"));
    CHECK(mcs.delay == 1s);
    mcs.clock.Advance(1s);
    SECTION("in time")
    {
        mcs.SendDelayed();
        REQUIRE(mcs.probe.GetAcks().size() == 1);
        CHECK(mcs.probe.GetAcks()[0].transactionID == "a");
        CHECK(mcs.delay == 1s);
    }
    SECTION("too late")
    {
        mcs.session.OnClosed(1, "gone", mcs.clock.GetNow(), mcs.probe.out);
        mcs.SendDelayed();
        CHECK(mcs.probe.out.empty());
    }
}

TEST_CASE("Of two holds on one command the latest applies")
{
    SimulatedMcsFixture mcs;
    mcs.Register(1);
    mcs.session.HoldAcks({std::nullopt, std::nullopt, 10s}, mcs.clock.GetNow());
    mcs.session.HoldAcks({EAcsCommand::PlanReport, 0ms, 10s}, mcs.clock.GetNow());
    mcs.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(mcs.delay == 0ms);
    mcs.Text(1, MakeRequestText("TscStateUpdate", R"({"state":"Auto"})", "b"));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
}

TEST_CASE("6.2 The requested number of registrations is refused, and one whose Ack is withheld has no effect")
{
    SimulatedMcsFixture mcs;
    mcs.session.RefuseRegistrations(1, "Maintenance.");
    mcs.Register(1);
    REQUIRE(mcs.probe.GetAcks().size() == 1);
    CHECK(mcs.probe.GetAcks()[0].result == EAckResult::Fail);
    CHECK(mcs.probe.GetAcks()[0].message == "Maintenance.");
    CHECK_FALSE(mcs.session.GetRegisteredOrNull().has_value());
    mcs.session.HoldAcks({EAcsCommand::Registration, std::nullopt, 5s}, mcs.clock.GetNow());
    mcs.Register(2);
    CHECK(mcs.probe.out.empty());
    CHECK_FALSE(mcs.session.GetRegisteredOrNull().has_value());
    mcs.clock.Advance(5s);
    mcs.Register(3);
    CHECK(mcs.session.GetRegisteredOrNull() == Protocol::ConnectionID(3));
}

TEST_CASE("6.2 Of withheld Acks and refused registrations the later fault applies; a refusal may be delayed")
{
    SimulatedMcsFixture mcs;
    SECTION("refused, though Acks are withheld")
    {
        mcs.session.HoldAcks({std::nullopt, std::nullopt, 1h}, mcs.clock.GetNow());
        mcs.session.RefuseRegistrations(1, "Maintenance.");
        mcs.Register(1);
        REQUIRE(mcs.probe.GetAcks().size() == 1);
        CHECK(mcs.probe.GetAcks()[0].message == "Maintenance.");
        mcs.Register(2);
        CHECK(mcs.probe.GetAcks().empty());
    }
    SECTION("withheld, then refused")
    {
        mcs.session.RefuseRegistrations(1, "Maintenance.");
        mcs.session.HoldAcks({EAcsCommand::Registration, std::nullopt, 5s}, mcs.clock.GetNow());
        mcs.Register(1);
        CHECK(mcs.probe.GetAcks().empty());
        mcs.clock.Advance(5s);
        mcs.Register(2);
        REQUIRE(mcs.probe.GetAcks().size() == 1);
        CHECK(mcs.probe.GetAcks()[0].result == EAckResult::Fail);
    }
    SECTION("refused late")
    {
        mcs.session.HoldAcks({EAcsCommand::Registration, 100ms, 5s}, mcs.clock.GetNow());
        mcs.session.RefuseRegistrations(1, "Maintenance.");
        mcs.Register(1);
        CHECK(mcs.probe.GetAcks().empty());
        mcs.clock.Advance(100ms);
        mcs.SendDelayed();
        REQUIRE(mcs.probe.GetAcks().size() == 1);
        CHECK(mcs.probe.GetAcks()[0].result == EAckResult::Fail);
    }
}

TEST_CASE("6.2 An ACS is registered when the Ack of its Registration leaves")
{
    SimulatedMcsFixture mcs;
    mcs.session.HoldAcks({std::nullopt, 1s, 10s}, mcs.clock.GetNow());
    mcs.Register(1);
    CHECK_FALSE(mcs.session.GetRegisteredOrNull().has_value());
    mcs.clock.Advance(1s);
    mcs.SendDelayed();
    CHECK(mcs.session.GetRegisteredOrNull().has_value());
    CHECK(mcs.probe.GetEvents<Protocol::Registered>().size() == 1);
    REQUIRE(mcs.probe.out.size() == 3);
    CHECK(std::holds_alternative<Protocol::CancelTimer>(mcs.probe.out[0]));
    CHECK(std::holds_alternative<Protocol::SendText>(mcs.probe.out[1]));
    CHECK(std::holds_alternative<Protocol::Deliver>(mcs.probe.out[2]));
}

TEST_CASE("6.2 A connection whose Registration is held is not closed as one without, in contrast to another connection")
{
    SimulatedMcsFixture mcs;
    mcs.session.HoldAcks({EAcsCommand::Registration, 12s, 30s}, mcs.clock.GetNow());
    mcs.Register(1);
    mcs.session.OnConnected(2, mcs.clock.GetNow(), mcs.probe.out);
    mcs.clock.Advance(10s);
    mcs.probe.Clear();
    mcs.session.OnTimer(Protocol::ESessionTimer::Registration, mcs.clock.GetNow(), mcs.probe.out);
    CHECK(mcs.probe.GetAll<Protocol::Close>().empty());
    const auto timers = mcs.probe.GetAll<Protocol::StartTimer>();
    REQUIRE(timers.size() == 1);
    CHECK(timers[0] == Protocol::StartTimer{Protocol::ESessionTimer::Registration, 2s});
    mcs.clock.Advance(2s);
    mcs.probe.Clear();
    mcs.session.OnTimer(Protocol::ESessionTimer::Registration, mcs.clock.GetNow(), mcs.probe.out);
    REQUIRE(mcs.probe.GetAll<Protocol::StartTimer>().size() == 1);
    CHECK(mcs.probe.GetAll<Protocol::StartTimer>()[0].delay == 1ms); // due, and not sent yet
    mcs.SendDelayed();
    CHECK(mcs.session.GetRegisteredOrNull() == Protocol::ConnectionID(1));
    mcs.session.OnTimer(Protocol::ESessionTimer::Registration, mcs.clock.GetNow(), mcs.probe.out);
    const auto closes = mcs.probe.GetAll<Protocol::Close>();
    REQUIRE(closes.size() == 1);
    CHECK(closes[0].connection == Protocol::ConnectionID(2));
}

TEST_CASE("Any text can be sent to the registered ACS")
{
    SimulatedMcsFixture mcs;
    CHECK_FALSE(mcs.session.TrySendText("{", mcs.probe.out));
    mcs.Register(1);
    mcs.probe.Clear();
    CHECK(mcs.session.TrySendText("{", mcs.probe.out));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().at(0).text == "{");
    CHECK(mcs.session.GetPendingCount() == 0);
}

TEST_CASE("EndFaults ends all holds and refusals")
{
    SimulatedMcsFixture mcs;
    mcs.session.HoldAcks({std::nullopt, std::nullopt, 1h}, mcs.clock.GetNow());
    mcs.session.RefuseRegistrations(5, "no");
    mcs.session.EndFaults();
    mcs.Register(1);
    CHECK(mcs.session.GetRegisteredOrNull().has_value());
    CHECK(mcs.probe.GetAcks().size() == 1);
}

TEST_CASE("12.1 With finalChunkBytes only the last chunk of a long text is read, which is lost without an Ack")
{
    McsBehaviour behaviour;
    behaviour.finalChunkBytes = 4096;
    SimulatedMcsFixture mcs(behaviour);
    mcs.Register(1);
    const std::string head = R"({"planId":"P","status":"Completed","message":")";
    const auto makeText = [&head](std::size_t size) {
        const std::size_t rest = MakeRequestText("PlanReport", head + "\"}").size();
        return MakeRequestText("PlanReport", head + std::string(size - rest, 'x') + "\"}");
    };
    mcs.Text(1, makeText(4096));
    CHECK(mcs.probe.GetAcks().size() == 1);
    for (const std::size_t size : {std::size_t{4097}, std::size_t{8192}, std::size_t{9000}})
    {
        mcs.Text(1, makeText(size));
        CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
        CHECK(mcs.probe.GetEvents<Protocol::RequestReceived>().empty());
        CHECK(mcs.probe.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::Undecodable});
    }
    // A complete message at the start of a chunk is read as such.
    mcs.Text(1, std::string(4096, ' ') + MakeRequestText("PlanReport", PLAN_REPORT, "z"));
    CHECK(mcs.probe.GetAcks().at(0).transactionID == "z");
}

TEST_CASE(
    "12.2, 12.5 With bErrorsUnanswered and bPositionsUnknown errors get no Ack, and positions are an unknown command")
{
    McsBehaviour behaviour;
    behaviour.bErrorsUnanswered = true;
    behaviour.bPositionsUnknown = true;
    SimulatedMcsFixture mcs(behaviour);
    mcs.Register(1);
    mcs.Text(1, MakeRequestText("PlanReport", R"({"planId":3})"));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
    mcs.Text(1, MakeRequestText("RobotPositionUpdate", R"({"robots":[]})"));
    CHECK(mcs.probe.GetAll<Protocol::SendText>().empty());
    CHECK(mcs.probe.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(mcs.probe.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::UnknownCommand});
}

TEST_CASE("12.8 With bNullResults requests carry a null result and message")
{
    McsBehaviour behaviour;
    behaviour.bNullResults = true;
    SimulatedMcsFixture mcs(behaviour);
    mcs.Register(1);
    mcs.probe.Clear();
    const Protocol::AcsRequest request = mcs.session.MakeRequest(Protocol::RequestAcsPlans{}, mcs.clock.GetNow());
    REQUIRE(mcs.session.TrySend(request, mcs.clock.GetNow(), mcs.probe.out));
    const std::string text = mcs.probe.GetAll<Protocol::SendText>().at(0).text;
    CHECK(text.find(R"("payload":{},"result":null,"message":null})") != std::string::npos);
    const Protocol::DecodeOutcome outcome = Protocol::AcsCodec().Decode(text);
    REQUIRE(outcome.message.has_value());
    CHECK(std::get<Protocol::AcsRequest>(*outcome.message) == request);
}

TEST_CASE("Statistics count the Acks that were sent, and the registrations that were refused or withheld")
{
    SimulatedMcsFixture mcs;
    mcs.session.RefuseRegistrations(1, "no");
    mcs.Register(1);
    mcs.session.HoldAcks({EAcsCommand::Registration, std::nullopt, 1s}, mcs.clock.GetNow());
    mcs.Register(2);
    mcs.clock.Advance(1s);
    mcs.Register(3);
    const Protocol::CommandCounters& counters = mcs.session.GetStatistics().Of(EAcsCommand::Registration);
    CHECK(counters.received == 3);
    CHECK(counters.acknowledged == 2);
    CHECK(counters.refused == 1);
}

TEST_CASE("Drop closes the registered connection, if there is one")
{
    SimulatedMcsFixture mcs;
    mcs.session.Drop(Protocol::CLOSE_NORMAL, "test", mcs.probe.out);
    CHECK(mcs.probe.out.empty());
    mcs.Register(1);
    mcs.probe.Clear();
    mcs.session.Drop(Protocol::CLOSE_ABNORMAL, "test", mcs.probe.out);
    CHECK(mcs.probe.GetAll<Protocol::Close>() == std::vector{Protocol::Close{1, Protocol::CLOSE_ABNORMAL, "test"}});
}

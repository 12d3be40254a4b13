#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include "SessionProbe.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/McsSession.hpp>

#include <chrono>
#include <string>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::EProtocolNote;
using Testing::MakeAckText;
using Testing::MakeRequestText;

namespace
{

const std::string PLAN_REPORT = R"({"planId":"P","status":"Completed","message":""})";

class McsBench
{
public:
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::McsSession session;
    Testing::SessionProbe probe;

    explicit McsBench(bool bSecondRefused = false)
        : McsBench(MakeOptions(bSecondRefused))
    {
    }

    explicit McsBench(const Protocol::McsSessionOptions& options)
        : session(options, random)
    {
    }

    static Protocol::McsSessionOptions MakeOptions(bool bSecondRefused)
    {
        Protocol::McsSessionOptions options;
        options.bSecondRefused = bSecondRefused;
        return options;
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
};

} // namespace

TEST_CASE("6.2 The MCS acknowledges a registration; what comes before it is answered with Fail and goes no further")
{
    McsBench bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.probe.out);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT));
    REQUIRE(bench.probe.GetAcks().size() == 1);
    CHECK(bench.probe.GetAcks()[0].result == EAckResult::Fail);
    CHECK(bench.probe.GetAcks()[0].message == "Register first.");
    CHECK(bench.probe.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.probe.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::BeforeRegistered});
    bench.Text(1, MakeRequestText("Registration", "{}", "r"));
    REQUIRE(bench.probe.GetAcks().size() == 1);
    CHECK(bench.probe.GetAcks()[0].transactionID == "r");
    CHECK(bench.probe.GetAcks()[0].result == EAckResult::Success);
    CHECK(bench.session.IsRegistered());
}

TEST_CASE("R3 A Registration that cannot be read is answered with Fail, and a good one may follow")
{
    McsBench bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.probe.out);
    bench.Text(1, MakeRequestText("Registration", "null", "r0"));
    const auto refusals = bench.probe.GetAll<Protocol::SendText>();
    REQUIRE(refusals.size() == 1);
    CHECK(refusals[0].text.find(R"("command":"RegistrationAck","transactionId":"r0")") != std::string::npos);
    CHECK(refusals[0].text.find(R"("result":"Fail")") != std::string::npos);
    CHECK_FALSE(bench.session.IsRegistered());
    bench.Text(1, MakeRequestText("Registration", "{}", "r1"));
    CHECK(bench.session.IsRegistered());
}

TEST_CASE("6.2 A connection from which no Registration comes is closed, so that idle ones do not keep the ACS out")
{
    McsBench bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.probe.out);
    bench.clock.Advance(4s);
    bench.session.OnConnected(2, bench.clock.GetNow(), bench.probe.out);
    bench.Text(2, MakeRequestText("Registration", "{}", "r"));
    bench.clock.Advance(6s);
    bench.probe.Clear();
    bench.session.OnTimer(Protocol::ESessionTimer::Registration, bench.clock.GetNow(), bench.probe.out);
    const auto closes = bench.probe.GetAll<Protocol::Close>();
    REQUIRE(closes.size() == 1);
    CHECK(closes[0].connection == 1);
    CHECK(closes[0].code == 1008);
    CHECK(bench.session.IsRegistered());
    CHECK(bench.probe.GetAll<Protocol::StartTimer>().empty());
}

TEST_CASE("6.2 Nobody is waited for any more once all connections have registered or gone")
{
    McsBench bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.probe.out);
    bench.session.OnConnected(2, bench.clock.GetNow(), bench.probe.out);
    bench.probe.Clear();
    bench.Text(1, MakeRequestText("Registration", "{}", "r"));
    CHECK(bench.probe.GetAll<Protocol::CancelTimer>().empty());
    bench.session.OnClosed(2, "", bench.clock.GetNow(), bench.probe.out);
    const auto cancels = bench.probe.GetAll<Protocol::CancelTimer>();
    REQUIRE(cancels.size() == 1);
    CHECK(cancels[0].timer == Protocol::ESessionTimer::Registration);
}

TEST_CASE("D-4 An Ack that comes after its request was given up is that request's, not the next one's of its command")
{
    McsBench bench;
    bench.Register(1);
    const auto send = [&bench](const std::string& planID) {
        const Protocol::AcsRequest request =
            bench.session.MakeRequest(Protocol::CancelPlan{planID, ""}, bench.clock.GetNow());
        REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.probe.out));
        return request.transactionID;
    };
    const std::string late = send("A");
    bench.clock.Advance(6s);
    bench.probe.Clear();
    bench.session.OnTimer(Protocol::ESessionTimer::Ack, bench.clock.GetNow(), bench.probe.out);
    REQUIRE(bench.probe.GetEvents<Protocol::RequestUnanswered>().size() == 1);
    const std::string present = send("B");
    for (const std::string& transactionID : {late, present})
    {
        bench.Text(1, MakeAckText("CancelPlan", transactionID));
        REQUIRE(bench.probe.GetEvents<Protocol::AckReceived>().size() == 1);
        CHECK(bench.probe.GetEvents<Protocol::AckReceived>()[0].ack.transactionID == transactionID);
        CHECK(bench.probe.GetNotes().empty());
    }
    bench.Text(1, MakeAckText("CancelPlan", present));
    CHECK(bench.probe.GetEvents<Protocol::AckReceived>().empty());
    CHECK(bench.probe.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckUnexpected});
}

TEST_CASE("R1, R2 The MCS acknowledges each report once, a repeated one again, positions never")
{
    McsBench bench;
    bench.Register(1);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(bench.probe.GetAcks().at(0).transactionID == "a");
    CHECK_FALSE(bench.probe.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(bench.probe.GetAcks().size() == 1);
    CHECK(bench.probe.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    const Protocol::CommandCounters& counters = bench.session.GetStatistics().Of(EAcsCommand::PlanReport);
    CHECK(counters.received == 2);
    CHECK(counters.acknowledged == 2);
    CHECK(counters.duplicates == 1);
    CHECK(counters.refused == 0);

    bench.Text(1, MakeRequestText("RobotPositionUpdate", R"({"robots":[]})"));
    CHECK(bench.probe.GetAll<Protocol::SendText>().empty());
    CHECK(bench.probe.GetEvents<Protocol::RequestReceived>().size() == 1);
    CHECK(bench.session.GetStatistics().Of(EAcsCommand::RobotPositionUpdate).received == 1);
}

TEST_CASE("R3 The MCS refuses what it cannot read and what is not for it")
{
    McsBench bench;
    bench.Register(1);
    bench.Text(1, MakeRequestText("PlanReport", R"({"planId":"P","status":"Dancing"})"));
    CHECK(bench.probe.GetAcks().at(0).result == EAckResult::Fail);
    bench.Text(1, MakeRequestText("RequestAcsPlans", "{}"));
    CHECK(bench.probe.GetAcks().at(0).message == "unsupported command");
    CHECK(bench.probe.GetEvents<Protocol::RequestReceived>().empty());
}

TEST_CASE("6.3 A request of the MCS is followed until its Ack")
{
    McsBench bench;
    const Protocol::AcsRequest request =
        bench.session.MakeRequest(Protocol::CancelPlan{"P", "r"}, bench.clock.GetNow());
    CHECK_FALSE(bench.session.TrySend(request, bench.clock.GetNow(), bench.probe.out));
    bench.Register(1);
    bench.probe.Clear();
    REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.probe.out));
    CHECK(bench.probe.GetRequests().at(0) == request);
    CHECK(bench.probe.GetDelayOrNull(Protocol::ESessionTimer::Ack) == 5s);
    CHECK(bench.session.GetPendingCount() == 1);
    SECTION("answered")
    {
        bench.Text(1, MakeAckText("CancelPlan", request.transactionID, "Fail"));
        CHECK(bench.probe.GetEvents<Protocol::AckReceived>().at(0).ack.result == EAckResult::Fail);
    }
    SECTION("answered with a foreign transactionId")
    {
        bench.Text(1, MakeAckText("CancelPlan", "other"));
        CHECK(bench.probe.GetEvents<Protocol::AckReceived>().at(0).ack.transactionID == request.transactionID);
    }
    SECTION("not answered in time")
    {
        bench.clock.Advance(5s);
        bench.probe.Clear();
        bench.session.OnTimer(Protocol::ESessionTimer::Ack, bench.clock.GetNow(), bench.probe.out);
        CHECK(bench.probe.GetEvents<Protocol::RequestUnanswered>().size() == 1);
    }
    SECTION("the link is lost")
    {
        bench.probe.Clear();
        bench.session.OnClosed(1, "gone", bench.clock.GetNow(), bench.probe.out);
        CHECK(bench.probe.GetEvents<Protocol::RequestUnanswered>().size() == 1);
        CHECK(bench.probe.GetEvents<Protocol::LinkLost>().size() == 1);
        CHECK_FALSE(bench.session.IsRegistered());
    }
    CHECK(bench.session.GetPendingCount() == 0);
}

TEST_CASE("12.3 A second client replaces the first, or is refused with 403 and 1008 by option")
{
    SECTION("replaces a half-open one")
    {
        McsBench bench;
        bench.Register(1);
        CHECK_FALSE(bench.session.ShouldRefuseUpgrade());
        bench.Register(2);
        CHECK(bench.probe.GetAll<Protocol::Close>().at(0).connection == 1);
        CHECK(bench.probe.GetEvents<Protocol::LinkLost>().size() == 1);
        CHECK(bench.probe.GetEvents<Protocol::Registered>().size() == 1);
        CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
        bench.probe.Clear();
        bench.session.OnClosed(1, "closed", bench.clock.GetNow(), bench.probe.out);
        CHECK(bench.probe.out.empty());
        CHECK(bench.session.IsRegistered());
    }
    SECTION("refused")
    {
        McsBench bench(true);
        CHECK_FALSE(bench.session.ShouldRefuseUpgrade());
        bench.Register(1);
        CHECK(bench.session.ShouldRefuseUpgrade());
        bench.Text(1, MakeRequestText("Registration", "{}", "again"));
        CHECK(bench.probe.GetAcks().at(0).result == EAckResult::Fail);
        CHECK(bench.probe.GetAll<Protocol::Close>().at(0).code == 1008);
    }
}

TEST_CASE("6 Both sessions together: a plan, its reports, a cut and a second registration")
{
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::AcsSession acs({}, random);
    Protocol::McsSession mcs({}, random);
    Testing::SessionProbe acsProbe;
    Testing::SessionProbe mcsProbe;
    // Carries texts to and fro until both are silent; returns the events in the probes.
    const auto exchange = [&](Protocol::ConnectionID connection) {
        std::size_t acsDone = 0;
        std::size_t mcsDone = 0;
        while (acsDone < acsProbe.out.size() || mcsDone < mcsProbe.out.size())
        {
            for (; acsDone < acsProbe.out.size(); ++acsDone)
            {
                if (const auto* sendOrNull = std::get_if<Protocol::SendText>(&acsProbe.out[acsDone]))
                {
                    mcs.OnText(connection, sendOrNull->text, clock.GetNow(), mcsProbe.out);
                }
            }
            for (; mcsDone < mcsProbe.out.size(); ++mcsDone)
            {
                if (const auto* sendOrNull = std::get_if<Protocol::SendText>(&mcsProbe.out[mcsDone]))
                {
                    acs.OnText(sendOrNull->text, clock.GetNow(), acsProbe.out);
                }
            }
        }
    };
    const auto connect = [&](Protocol::ConnectionID connection) {
        acsProbe.Clear();
        mcsProbe.Clear();
        mcs.OnConnected(connection, clock.GetNow(), mcsProbe.out);
        acs.OnConnected(clock.GetNow(), acsProbe.out);
        exchange(connection);
        REQUIRE(acs.IsRegistered());
        REQUIRE(mcs.IsRegistered());
    };
    acs.Start(clock.GetNow(), acsProbe.out);
    connect(1);

    const Protocol::AcsRequest plan =
        mcs.MakeRequest(Protocol::ExecutionPlan{"P", "L", {}, {{1, "Start", "A01.SET01", {}, {}}}}, clock.GetNow());
    acsProbe.Clear();
    mcsProbe.Clear();
    REQUIRE(mcs.TrySend(plan, clock.GetNow(), mcsProbe.out));
    exchange(1);
    CHECK(acsProbe.GetEvents<Protocol::RequestReceived>().at(0).request == plan);
    acsProbe.Clear();
    acs.Answer(
        EAcsCommand::ExecutionPlan,
        plan.transactionID,
        EAckResult::Success,
        "",
        Protocol::PlanAck{"P"},
        clock.GetNow(),
        acsProbe.out);
    const Protocol::AcsRequest report{"rep-1", {}, Protocol::PlanReport{"P", Protocol::EPlanStatus::Completed, ""}};
    REQUIRE(acs.TrySendDurable(report, clock.GetNow(), acsProbe.out));
    mcsProbe.Clear();
    // The answers of the MCS are lost with the link.
    for (const Protocol::SendText& send : acsProbe.GetAll<Protocol::SendText>())
    {
        mcs.OnText(1, send.text, clock.GetNow(), mcsProbe.out);
    }
    CHECK(mcsProbe.GetEvents<Protocol::AckReceived>().size() == 1);
    mcs.OnClosed(1, "cut", clock.GetNow(), mcsProbe.out);
    acs.OnClosed("cut", clock.GetNow(), acsProbe.out);
    clock.Advance(10s);
    acs.OnTimer(Protocol::ESessionTimer::Reconnect, clock.GetNow(), acsProbe.out);
    connect(2);
    acsProbe.Clear();
    mcsProbe.Clear();
    REQUIRE(acs.TrySendDurable(report, clock.GetNow(), acsProbe.out));
    acs.ReplayDone(clock.GetNow(), acsProbe.out);
    exchange(2);
    CHECK(acsProbe.GetEvents<Protocol::Acked>().at(0).transactionID == "rep-1");
    CHECK(mcsProbe.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    CHECK(mcs.GetStatistics().Of(EAcsCommand::PlanReport).received == 2);
    CHECK(mcs.GetStatistics().Of(EAcsCommand::PlanReport).duplicates == 1);
}

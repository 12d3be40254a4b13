#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "ManualClock.hpp"
#include "McsSessionFixture.hpp"
#include "SeededRandom.hpp"
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
using Testing::McsSessionFixture;

namespace
{

const std::string PLAN_REPORT = R"({"planId":"P","status":"Completed","message":""})";

} // namespace

TEST_CASE("6.2 The MCS acknowledges a registration; earlier requests are answered with Fail and not delivered")
{
    McsSessionFixture bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.recorder.out);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT));
    REQUIRE(bench.recorder.GetAcks().size() == 1);
    CHECK(bench.recorder.GetAcks()[0].result == EAckResult::Fail);
    CHECK(bench.recorder.GetAcks()[0].message == "Register first.");
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::BeforeRegistered});
    bench.Text(1, MakeRequestText("Registration", "{}", "r"));
    REQUIRE(bench.recorder.GetAcks().size() == 1);
    CHECK(bench.recorder.GetAcks()[0].transactionID == "r");
    CHECK(bench.recorder.GetAcks()[0].result == EAckResult::Success);
    CHECK(bench.session.IsRegistered());
}

TEST_CASE("R3 An undecodable Registration is answered with Fail, and a valid one may follow")
{
    McsSessionFixture bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.recorder.out);
    bench.Text(1, MakeRequestText("Registration", "null", "r0"));
    const auto refusals = bench.recorder.GetAll<Protocol::SendText>();
    REQUIRE(refusals.size() == 1);
    CHECK(refusals[0].text.find(R"("command":"RegistrationAck","transactionId":"r0")") != std::string::npos);
    CHECK(refusals[0].text.find(R"("result":"Fail")") != std::string::npos);
    CHECK_FALSE(bench.session.IsRegistered());
    bench.Text(1, MakeRequestText("Registration", "{}", "r1"));
    CHECK(bench.session.IsRegistered());
}

TEST_CASE("6.2 A connection without a Registration is closed, so that idle ones do not keep the ACS out")
{
    McsSessionFixture bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.recorder.out);
    bench.clock.Advance(4s);
    bench.session.OnConnected(2, bench.clock.GetNow(), bench.recorder.out);
    bench.Text(2, MakeRequestText("Registration", "{}", "r"));
    bench.clock.Advance(6s);
    bench.recorder.Clear();
    bench.session.OnTimer(Protocol::ESessionTimer::Registration, bench.clock.GetNow(), bench.recorder.out);
    const auto closes = bench.recorder.GetAll<Protocol::Close>();
    REQUIRE(closes.size() == 1);
    CHECK(closes[0].connection == 1);
    CHECK(closes[0].code == 1008);
    CHECK(bench.session.IsRegistered());
    CHECK(bench.recorder.GetAll<Protocol::StartTimer>().empty());
    bench.recorder.Clear();
    bench.Text(1, MakeRequestText("Registration", "{}", "late"));
    CHECK(bench.recorder.out.empty());
    CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
}

TEST_CASE("6.2 No Registration is awaited once all connections have registered or closed")
{
    McsSessionFixture bench;
    bench.session.OnConnected(1, bench.clock.GetNow(), bench.recorder.out);
    bench.session.OnConnected(2, bench.clock.GetNow(), bench.recorder.out);
    bench.recorder.Clear();
    bench.Text(1, MakeRequestText("Registration", "{}", "r"));
    CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().empty());
    bench.session.OnClosed(2, "", bench.clock.GetNow(), bench.recorder.out);
    const auto cancels = bench.recorder.GetAll<Protocol::CancelTimer>();
    REQUIRE(cancels.size() == 1);
    CHECK(cancels[0].timer == Protocol::ESessionTimer::Registration);
}

TEST_CASE("D-4 An Ack after its request has expired does not acknowledge the next request of the command")
{
    McsSessionFixture bench;
    bench.Register(1);
    const auto send = [&bench](const std::string& planID) {
        const Protocol::AcsRequest request =
            bench.session.MakeRequest(Protocol::CancelPlan{planID, ""}, bench.clock.GetNow());
        REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.recorder.out));
        return request.transactionID;
    };
    const std::string late = send("A");
    bench.clock.Advance(6s);
    bench.recorder.Clear();
    bench.session.OnTimer(Protocol::ESessionTimer::Ack, bench.clock.GetNow(), bench.recorder.out);
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestUnanswered>().size() == 1);
    const std::string present = send("B");
    for (const std::string& transactionID : {late, present})
    {
        bench.Text(1, MakeAckText("CancelPlan", transactionID));
        REQUIRE(bench.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
        CHECK(bench.recorder.GetEvents<Protocol::AckReceived>()[0].ack.transactionID == transactionID);
        CHECK(bench.recorder.GetNotes().empty());
    }
    bench.Text(1, MakeAckText("CancelPlan", present));
    CHECK(bench.recorder.GetEvents<Protocol::AckReceived>().empty());
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckUnexpected});
}

TEST_CASE("D-4 An Ack that names another plan acknowledges no request of its command")
{
    McsSessionFixture bench;
    bench.Register(1);
    for (const char* planID : {"B", "C"})
    {
        const Protocol::AcsRequest request =
            bench.session.MakeRequest(Protocol::CancelPlan{planID, ""}, bench.clock.GetNow());
        REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.recorder.out));
    }
    const std::vector<Protocol::AcsRequest> requests = bench.recorder.GetRequests();
    bench.Text(1, MakeAckText("CancelPlan", "of another run", "Success", R"({"planId":"A"})"));
    CHECK(bench.recorder.GetEvents<Protocol::AckReceived>().empty());
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckUnexpected});
    bench.Text(1, MakeAckText("CancelPlan", "foreign", "Success", R"({"planId":"C"})"));
    REQUIRE(bench.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
    CHECK(bench.recorder.GetEvents<Protocol::AckReceived>()[0].ack.transactionID == requests.at(1).transactionID);
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckMismatched});
}

TEST_CASE("D-4 A late Ack is known for as many requests as may be pending")
{
    McsSessionFixture bench;
    bench.Register(1);
    bench.recorder.Clear();
    const auto send = [&bench] {
        const Protocol::AcsRequest request =
            bench.session.MakeRequest(Protocol::CancelPlan{"P", ""}, bench.clock.GetNow());
        REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.recorder.out));
        return request.transactionID;
    };
    const std::string first = send();
    for (int count = 1; count < 200; ++count)
    {
        static_cast<void>(send());
    }
    bench.session.OnClosed(1, "gone", bench.clock.GetNow(), bench.recorder.out);
    bench.Register(2);
    static_cast<void>(send());
    bench.Text(2, MakeAckText("CancelPlan", first));
    REQUIRE(bench.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
    CHECK(bench.recorder.GetEvents<Protocol::AckReceived>()[0].bLate);
    CHECK(bench.recorder.GetEvents<Protocol::AckReceived>()[0].ack.transactionID == first);
    bench.Text(2, MakeAckText("CancelPlan", first));
    CHECK(bench.recorder.GetNotes() == std::vector<EProtocolNote>{EProtocolNote::AckUnexpected});
}

TEST_CASE("R1, R2 The MCS acknowledges each report once, a repeated one again, positions never")
{
    McsSessionFixture bench;
    bench.Register(1);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(bench.recorder.GetAcks().at(0).transactionID == "a");
    CHECK_FALSE(bench.recorder.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    bench.Text(1, MakeRequestText("PlanReport", PLAN_REPORT, "a"));
    CHECK(bench.recorder.GetAcks().size() == 1);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    const Protocol::CommandCounters& counters = bench.session.GetStatistics().Of(EAcsCommand::PlanReport);
    CHECK(counters.received == 2);
    CHECK(counters.acknowledged == 2);
    CHECK(counters.duplicates == 1);
    CHECK(counters.refused == 0);

    bench.Text(1, MakeRequestText("RobotPositionUpdate", R"({"robots":[]})"));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    CHECK(bench.session.GetStatistics().Of(EAcsCommand::RobotPositionUpdate).received == 1);
}

TEST_CASE("R3 The MCS rejects undecodable messages and messages that are not for an MCS")
{
    McsSessionFixture bench;
    bench.Register(1);
    bench.Text(1, MakeRequestText("PlanReport", R"({"planId":"P","status":"Dancing"})"));
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Fail);
    bench.Text(1, MakeRequestText("RequestAcsPlans", "{}"));
    CHECK(bench.recorder.GetAcks().at(0).message == "unsupported command");
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
}

TEST_CASE("6.3 A request of the MCS is tracked until its Ack")
{
    McsSessionFixture bench;
    const Protocol::AcsRequest request =
        bench.session.MakeRequest(Protocol::CancelPlan{"P", "r"}, bench.clock.GetNow());
    CHECK_FALSE(bench.session.TrySend(request, bench.clock.GetNow(), bench.recorder.out));
    bench.Register(1);
    bench.recorder.Clear();
    REQUIRE(bench.session.TrySend(request, bench.clock.GetNow(), bench.recorder.out));
    CHECK(bench.recorder.GetRequests().at(0) == request);
    CHECK(bench.recorder.GetDelayOrNull(Protocol::ESessionTimer::Ack) == 5s);
    CHECK(bench.session.GetPendingCount() == 1);
    SECTION("answered")
    {
        bench.Text(1, MakeAckText("CancelPlan", request.transactionID, "Fail"));
        CHECK(bench.recorder.GetEvents<Protocol::AckReceived>().at(0).ack.result == EAckResult::Fail);
    }
    SECTION("answered with a foreign transactionId")
    {
        bench.Text(1, MakeAckText("CancelPlan", "other"));
        CHECK(bench.recorder.GetEvents<Protocol::AckReceived>().at(0).ack.transactionID == request.transactionID);
    }
    SECTION("not answered in time")
    {
        bench.clock.Advance(5s);
        bench.recorder.Clear();
        bench.session.OnTimer(Protocol::ESessionTimer::Ack, bench.clock.GetNow(), bench.recorder.out);
        CHECK(bench.recorder.GetEvents<Protocol::RequestUnanswered>().size() == 1);
    }
    SECTION("the link is lost")
    {
        bench.recorder.Clear();
        bench.session.OnClosed(1, "gone", bench.clock.GetNow(), bench.recorder.out);
        CHECK(bench.recorder.GetEvents<Protocol::RequestUnanswered>().size() == 1);
        CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().size() == 1);
        CHECK_FALSE(bench.session.IsRegistered());
    }
    CHECK(bench.session.GetPendingCount() == 0);
}

TEST_CASE("12.3 A second client replaces the first, or by option is rejected with 403 and 1008")
{
    SECTION("replaces a half-open one")
    {
        McsSessionFixture bench;
        bench.Register(1);
        CHECK_FALSE(bench.session.ShouldRefuseUpgrade());
        bench.Register(2);
        CHECK(bench.recorder.GetAll<Protocol::Close>().at(0).connection == 1);
        CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().size() == 1);
        CHECK(bench.recorder.GetEvents<Protocol::Registered>().size() == 1);
        CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
        bench.recorder.Clear();
        bench.Text(1, MakeRequestText("Registration", "{}", "late"));
        bench.session.OnClosed(1, "closed", bench.clock.GetNow(), bench.recorder.out);
        CHECK(bench.recorder.out.empty());
        CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
        CHECK(bench.session.IsRegistered());
    }
    SECTION("refused")
    {
        McsSessionFixture bench(true);
        CHECK_FALSE(bench.session.ShouldRefuseUpgrade());
        bench.Register(1);
        CHECK(bench.session.ShouldRefuseUpgrade());
        bench.Text(1, MakeRequestText("Registration", "{}", "again"));
        CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Fail);
        CHECK(bench.recorder.GetAll<Protocol::Close>().at(0).code == 1008);
    }
}

TEST_CASE("6 Both sessions together: a plan, its reports, a lost link and a second registration")
{
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    Protocol::AcsSession acs({}, random);
    Protocol::McsSession mcs({}, random);
    Testing::ActionRecorder acsRecorder;
    Testing::ActionRecorder mcsRecorder;
    // Exchanges texts until both sides are silent; the recorders have the events.
    const auto exchange = [&](Protocol::ConnectionID connection) {
        std::size_t acsDone = 0;
        std::size_t mcsDone = 0;
        while (acsDone < acsRecorder.out.size() || mcsDone < mcsRecorder.out.size())
        {
            for (; acsDone < acsRecorder.out.size(); ++acsDone)
            {
                if (const auto* sendOrNull = std::get_if<Protocol::SendText>(&acsRecorder.out[acsDone]))
                {
                    mcs.OnText(connection, sendOrNull->text, clock.GetNow(), mcsRecorder.out);
                }
            }
            for (; mcsDone < mcsRecorder.out.size(); ++mcsDone)
            {
                if (const auto* sendOrNull = std::get_if<Protocol::SendText>(&mcsRecorder.out[mcsDone]))
                {
                    acs.OnText(sendOrNull->text, clock.GetNow(), acsRecorder.out);
                }
            }
        }
    };
    const auto connect = [&](Protocol::ConnectionID connection) {
        acsRecorder.Clear();
        mcsRecorder.Clear();
        mcs.OnConnected(connection, clock.GetNow(), mcsRecorder.out);
        acs.OnConnected(clock.GetNow(), acsRecorder.out);
        exchange(connection);
        REQUIRE(acs.IsRegistered());
        REQUIRE(mcs.IsRegistered());
    };
    acs.Start(clock.GetNow(), acsRecorder.out);
    connect(1);

    const Protocol::AcsRequest plan =
        mcs.MakeRequest(Protocol::ExecutionPlan{"P", "L", {}, {{1, "Start", "A01.SET01", {}, {}}}}, clock.GetNow());
    acsRecorder.Clear();
    mcsRecorder.Clear();
    REQUIRE(mcs.TrySend(plan, clock.GetNow(), mcsRecorder.out));
    exchange(1);
    CHECK(acsRecorder.GetEvents<Protocol::RequestReceived>().at(0).request == plan);
    acsRecorder.Clear();
    acs.Answer(
        EAcsCommand::ExecutionPlan,
        plan.transactionID,
        EAckResult::Success,
        "",
        Protocol::PlanAck{"P"},
        clock.GetNow(),
        acsRecorder.out);
    const Protocol::AcsRequest report{"rep-1", {}, Protocol::PlanReport{"P", Protocol::EPlanStatus::Completed, ""}};
    REQUIRE(acs.TrySendDurable(report, clock.GetNow(), acsRecorder.out));
    mcsRecorder.Clear();
    // The answers of the MCS are lost with the link.
    for (const Protocol::SendText& send : acsRecorder.GetAll<Protocol::SendText>())
    {
        mcs.OnText(1, send.text, clock.GetNow(), mcsRecorder.out);
    }
    CHECK(mcsRecorder.GetEvents<Protocol::AckReceived>().size() == 1);
    mcs.OnClosed(1, "cut", clock.GetNow(), mcsRecorder.out);
    acs.OnClosed("cut", clock.GetNow(), acsRecorder.out);
    clock.Advance(10s);
    acs.OnTimer(Protocol::ESessionTimer::Reconnect, clock.GetNow(), acsRecorder.out);
    connect(2);
    acsRecorder.Clear();
    mcsRecorder.Clear();
    REQUIRE(acs.TrySendDurable(report, clock.GetNow(), acsRecorder.out));
    acs.ReplayDone(clock.GetNow(), acsRecorder.out);
    exchange(2);
    CHECK(acsRecorder.GetEvents<Protocol::Acked>().at(0).transactionID == "rep-1");
    CHECK(mcsRecorder.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
    CHECK(mcs.GetStatistics().Of(EAcsCommand::PlanReport).received == 2);
    CHECK(mcs.GetStatistics().Of(EAcsCommand::PlanReport).duplicates == 1);
}

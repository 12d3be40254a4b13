#include "AcsSessionFixture.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"

#include <chrono>
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

TEST_CASE("R1, R2 Every request is answered with its own transactionId")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.Text(MakeRequestText("CancelPlan", R"({"planId":"P","reason":"r"})", "t-9"));
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    bench.recorder.Clear();
    bench.session.Answer(
        EAcsCommand::CancelPlan,
        "t-9",
        EAckResult::Success,
        "",
        Protocol::PlanAck{"P"},
        bench.clock.GetNow(),
        bench.recorder.out);
    const std::vector<Protocol::AcsAck> acks = bench.recorder.GetAcks();
    REQUIRE(acks.size() == 1);
    CHECK(acks[0].transactionID == "t-9");
    CHECK(acks[0].command == EAcsCommand::CancelPlan);
    CHECK(acks[0].payload == Protocol::AckPayload(Protocol::PlanAck{"P"}));
}

TEST_CASE("A received time without an offset has that of the site, also after it has changed")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.session.SetSiteOffset(9h);
    bench.Text(R"({"command":"CancelPlan","transactionId":"t-1","timestamp":"2025-07-02T21:00:00",)"
               R"("payload":{"planId":"P","reason":""}})");
    const auto received = bench.recorder.GetEvents<Protocol::RequestReceived>();
    REQUIRE(received.size() == 1);
    CHECK(received[0].request.timestamp == Core::Timestamp{Core::WallTime(1'751'457'600'000ms), 9h});
}

TEST_CASE("R1, R3 An undefined request is answered with Fail and a reason, and not delivered")
{
    struct Case
    {
        std::string text;
        std::string command;
        std::string message;
    };
    const std::vector<Case> cases{
        {MakeRequestText("Dance", "{}"), "DanceAck", "unsupported command"},
        {MakeRequestText("PlanReport", R"({"planId":"P","status":"Failed","message":""})"),
         "PlanReportAck",
         "unsupported command"},
        {MakeRequestText("PlanReport", "{}"), "PlanReportAck", "unsupported command"},
        {MakeRequestText("ExecutionPlan", "null"), "ExecutionPlanAck", "payload: expected an object"},
        {MakeRequestText("CancelPlan", "{}"), "CancelPlanAck", "payload.planId: expected a value"},
        {MakeRequestText("RequestAcsPlans", "null"), "RequestAcsPlansAck", "payload: expected an object"},
    };
    for (const Case& bad : cases)
    {
        INFO(bad.text);
        Fixture bench;
        bench.StartAndReplay();
        bench.Text(bad.text);
        CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
        const auto sent = bench.recorder.GetAll<Protocol::SendText>();
        REQUIRE(sent.size() == 1);
        INFO(sent[0].text);
        CHECK(sent[0].text.find("\"command\":\"" + bad.command + "\",\"transactionId\":\"t-1\"") != std::string::npos);
        CHECK(sent[0].text.find(R"("result":"Fail")") != std::string::npos);
        CHECK(sent[0].text.find("\"message\":\"" + bad.message) != std::string::npos);
    }
}

TEST_CASE("R1 A text that cannot be answered is counted, and the connection continues")
{
    Fixture bench;
    bench.StartAndReplay();
    for (const std::string text : {"not JSON", "[]", "{}", R"({"command":"DanceAck"})"})
    {
        bench.Text(text);
        CHECK(bench.recorder.out.size() == 1);
        CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::Undecodable});
    }
    bench.Text(MakeRequestText("RobotPositionUpdate", R"({"robots":[]})"));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.session.IsRegistered());
}

TEST_CASE("D-23 Another request with a known transactionId is rejected, not answered like the first one")
{
    Fixture bench;
    bench.StartAndReplay();
    const std::string plan = Testing::ReadFixture("ExecutionPlanLR");
    bench.Text(plan);
    bench.AnswerPlan();
    const std::string first = bench.recorder.GetAll<Protocol::SendText>().back().text;

    std::string other = plan;
    other.replace(other.find("PLAN-20250702-001"), std::string("PLAN-20250702-001").size(), "PLAN-20250702-002");
    bench.Text(other);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    const auto refused = bench.recorder.GetEvents<Protocol::RequestRefused>();
    REQUIRE(refused.size() == 1);
    CHECK(refused.front().planID == "PLAN-20250702-002");
    CHECK(refused.front().path == "transactionId");
    const std::string ack = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    CHECK(ack.find(R"("result":"Fail")") != std::string::npos);
    CHECK(ack.find("PLAN-20250702-002") != std::string::npos);

    std::string later = plan; // the same request, sent again
    const std::size_t time = later.find("\"timestamp\"");
    later.replace(later.find("2025", time), 4, "2026");
    bench.Text(later);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == first);
}

TEST_CASE("13.5 A repeated request is answered with the same text and executed once")
{
    Fixture bench;
    bench.StartAndReplay();
    const std::string plan = Testing::ReadFixture("ExecutionPlanLR");
    bench.Text(plan);
    REQUIRE(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    bench.Text(plan);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetNotes() == Notes{EProtocolNote::DuplicateRequest});

    bench.recorder.Clear();
    bench.AnswerPlan();
    const std::string first = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    bench.recorder.Clear();
    bench.AnswerPlan();
    CHECK(bench.recorder.out.empty());

    bench.clock.Advance(9min);
    bench.Text(plan);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == first);

    SECTION("also on the next connection, where the first answer may have been lost")
    {
        bench.Closed();
        bench.Timer(ESessionTimer::Reconnect, 10s);
        bench.Register();
        bench.Text(plan);
        CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == first);
    }
    SECTION("but not indefinitely")
    {
        bench.clock.Advance(2min);
        bench.Text(plan);
        CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().size() == 1);
    }
}

TEST_CASE("D-5 RequestAcsStatus is answered under its own name")
{
    Fixture bench;
    bench.StartAndReplay();
    bench.Text(MakeRequestText("RequestAcsStatus", "{}"));
    bench.recorder.Clear();
    bench.session.Answer(
        EAcsCommand::RequestAcsPlans,
        "t-1",
        EAckResult::Success,
        "",
        Protocol::PlanListAck{},
        bench.clock.GetNow(),
        bench.recorder.out);
    CHECK(
        bench.recorder.GetAll<Protocol::SendText>().at(0).text.find(R"("command":"RequestAcsStatusAck")")
        != std::string::npos);
}

TEST_CASE("Only a report is sent as a durable request")
{
    const Protocol::AcsPayload report = GENERATE(
        Protocol::AcsPayload(Protocol::PlanReport{}),
        Protocol::AcsPayload(Protocol::StepReport{}),
        Protocol::AcsPayload(Protocol::JobReport{}),
        Protocol::AcsPayload(Protocol::CancelResultReport{}),
        Protocol::AcsPayload(Protocol::AbortResultReport{}),
        Protocol::AcsPayload(Protocol::PauseResultReport{}),
        Protocol::AcsPayload(Protocol::ResumeResultReport{}),
        Protocol::AcsPayload(Protocol::ErrorReport{}));
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.recorder.Clear();
    CHECK(bench.session.TrySendDurable({"report", {}, report}, bench.clock.GetNow(), bench.recorder.out));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().size() == 1);
}

TEST_CASE("A command of the MCS, a state, a position or a Registration is no durable request")
{
    const Protocol::AcsPayload payload = GENERATE(
        Protocol::AcsPayload(Protocol::ExecutionPlan{}),
        Protocol::AcsPayload(Protocol::RequestAcsErrorList{}),
        Protocol::AcsPayload(Protocol::Registration{}),
        Protocol::AcsPayload(Protocol::TscStateUpdate{}),
        Protocol::AcsPayload(Protocol::AcsCommStateUpdate{}),
        Protocol::AcsPayload(Protocol::RobotStatusUpdate{}),
        Protocol::AcsPayload(Protocol::RobotPositionUpdate{}));
    Testing::AcsSessionFixture bench;
    bench.StartAndReplay();
    bench.recorder.Clear();
    CHECK_FALSE(bench.session.TrySendDurable({"other", {}, payload}, bench.clock.GetNow(), bench.recorder.out));
    CHECK(bench.recorder.out.empty());
    CHECK(bench.session.GetRoom() == Testing::MakeOptions().window);
}

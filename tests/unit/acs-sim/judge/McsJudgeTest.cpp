#include "JudgeFixture.hpp"
#include "SeededRandom.hpp"

#include <chrono>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using ACS::AcsSim::ERule;
using ACS::Testing::JudgeFixture;

namespace
{

using Rules = std::vector<ERule>;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds LONG{6};

} // namespace

TEST_CASE("A correct MCS violates nothing, and what was seen is ok in the table")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Ask("PlanReport", 3, JudgeFixture::REPORT);
    fixture.Ask("TscStateUpdate", 4, JudgeFixture::STATE);
    fixture.Received(JudgeFixture::MakeRequest("PausePlan", 5, R"({"planId":"P","reason":""})"));
    fixture.Received(JudgeFixture::MakeRequest("RequestAcsPlans", 6, "{}"));
    fixture.Wait(LONG);
    CHECK(fixture.GetViolated().empty());
    CHECK_FALSE(fixture.judge.GetBook().IsViolated());
    CHECK(fixture.judge.ListOpenRequests().empty());
    const std::vector<std::string> table = fixture.judge.GetBook().MakeTable();
    REQUIRE(table.size() == ACS::AcsSim::RULE_COUNT + 1);
    CHECK(table[1].find("registration         6.2       ok (1)") == 0);
    CHECK(table[3].find("reconnect            6.2       not seen") == 0);
}

TEST_CASE("Each rule has a name of its own, a section and a sentence")
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < ACS::AcsSim::RULE_COUNT; ++i)
    {
        const auto rule = static_cast<ERule>(i);
        CHECK(names.insert(GetName(rule)).second);
        CHECK_FALSE(GetSection(rule).empty());
        CHECK(GetMeaning(rule).ends_with('.'));
    }
}

TEST_CASE("6.2 A Registration without an answer, and one that is refused")
{
    JudgeFixture fixture;
    fixture.Sent(JudgeFixture::MakeRequest("Registration", 1, "{}"));
    fixture.Wait(seconds(5));
    CHECK(fixture.GetViolated().empty());
    SECTION("time passes")
    {
        fixture.Wait(milliseconds(1));
    }
    SECTION("the connection is closed")
    {
        fixture.judge.OnClosed(false);
    }
    SECTION("Fail")
    {
        fixture.Received(JudgeFixture::MakeAck("Registration", 1, "Fail"));
    }
    CHECK(fixture.GetViolated() == Rules{ERule::RegistrationAnswered});
}

TEST_CASE("5 A request before the RegistrationAck")
{
    JudgeFixture fixture;
    fixture.Sent(JudgeFixture::MakeRequest("Registration", 1, "{}"));
    fixture.Received(JudgeFixture::MakeRequest("RequestAcsPlans", 2, "{}"));
    CHECK(fixture.GetViolated() == Rules{ERule::NothingBeforeRegistration});
}

TEST_CASE("6, 6.1 Texts and envelopes that are not as specified")
{
    JudgeFixture fixture;
    fixture.Begin();
    const auto& [rule, text] = GENERATE(
        std::pair{ERule::JsonObject, std::string()},
        std::pair{ERule::JsonObject, std::string("\xFF\xFE")},
        std::pair{ERule::JsonObject, std::string("[1,2]")},
        std::pair{ERule::JsonObject, std::string(R"({"command":)")},
        std::pair{ERule::JsonObject, std::string(100'000, '[')},
        std::pair{ERule::Envelope, std::string("{}")},
        std::pair{ERule::Envelope, std::string(R"({"command":17})")},
        std::pair{
            ERule::Envelope,
            std::string(
                R"({"command":"RequestAcsPlans","transactionId":"00000000-0000-4000-8000-000000000009","payload":{}})")},
        std::pair{
            ERule::Envelope,
            std::string(R"({"command":"RequestAcsPlans","timestamp":"2025-07-02T21:00:00.123+09:00","payload":{}})")});
    fixture.Received(text);
    const Rules violated = fixture.GetViolated();
    REQUIRE_FALSE(violated.empty());
    CHECK(violated.front() == rule);
}

TEST_CASE("6.1 The timestamp cannot be read")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Received(
        R"({"command":"RequestAcsPlans","transactionId":"00000000-0000-4000-8000-000000000009","timestamp":"noon","payload":{}})");
    CHECK(fixture.GetViolated() == Rules{ERule::Timestamp});
}

TEST_CASE("6.1 A transactionId is a UUID and is used for one request; the same request may be repeated")
{
    JudgeFixture fixture;
    fixture.Begin();
    const std::string query = JudgeFixture::MakeRequest("RequestAcsPlanHistory", 7, R"({"planIds":["A"]})");
    fixture.Received(query);
    fixture.Received(query);
    fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 2, JudgeFixture::PLAN));
    CHECK(fixture.GetViolated().empty());
    SECTION("two requests")
    {
        fixture.Received(JudgeFixture::MakeRequest("RequestAcsPlanHistory", 7, R"({"planIds":["B"]})"));
    }
    SECTION("no UUID")
    {
        fixture.Received(
            R"({"command":"RequestAcsPlans","transactionId":"7","timestamp":"2025-07-02T21:00:00Z","payload":{}})");
    }
    CHECK(fixture.GetViolated() == Rules{ERule::TransactionID});
}

TEST_CASE("5.1, 6.5 to 6.11 Commands and payloads of the MCS")
{
    JudgeFixture fixture;
    fixture.Begin();
    const auto& [rule, text] = GENERATE(
        std::pair{ERule::KnownCommand, JudgeFixture::MakeRequest("Dance", 9, "{}")},
        std::pair{ERule::KnownCommand, JudgeFixture::MakeRequest("TscStateUpdate", 9, JudgeFixture::STATE)},
        std::pair{ERule::KnownCommand, JudgeFixture::MakeRequest("TscStateUpdate", 9, "{}")},
        std::pair{ERule::RequestPayload, JudgeFixture::MakeRequest("CancelPlan", 9, "{}")},
        std::pair{ERule::RequestPayload, JudgeFixture::MakeRequest("RequestAcsPlanHistory", 9, "{}")},
        std::pair{ERule::PlanPayload, JudgeFixture::MakeRequest("ExecutionPlan", 9, R"({"planId":"Q","steps":[]})")},
        std::pair{
            ERule::PlanLocation,
            JudgeFixture::MakeRequest(
                "ExecutionPlan",
                9,
                R"({"planId":"Q","steps":[{"stepNo":1,"action":"Start","position":"here","carrierIds":[],"jobs":[]}]})")},
        std::pair{
            ERule::ControlOfKnownPlan,
            JudgeFixture::MakeRequest("AbortPlan", 9, R"({"planId":"Q","reason":""})")},
        std::pair{ERule::PlanID, JudgeFixture::MakeRequest("ExecutionPlan", 9, JudgeFixture::PLAN)});
    fixture.Received(text);
    CHECK(fixture.GetViolated() == Rules{rule});
}

TEST_CASE("6.1 A report without an Ack, and one whose Ack comes late")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Sent(JudgeFixture::MakeRequest("PlanReport", 3, JudgeFixture::REPORT));
    CHECK(fixture.judge.ListOpenRequests().size() == 1);
    SECTION("none")
    {
        fixture.Wait(LONG);
        fixture.Wait(LONG);
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3));
    }
    SECTION("late")
    {
        fixture.clock.Advance(LONG);
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3));
    }
    CHECK(fixture.GetViolated() == Rules{ERule::Acknowledged});
    CHECK(fixture.judge.GetBook().GetRow(ERule::Acknowledged).violated == 1);
    CHECK(fixture.judge.ListOpenRequests().empty());
}

TEST_CASE("6.1 Acks that are not as specified")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Sent(JudgeFixture::MakeRequest("PlanReport", 3, JudgeFixture::REPORT));
    ERule expected = ERule::AcknowledgedOnce;
    SECTION("twice")
    {
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3));
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3));
    }
    SECTION("foreign transactionId: the report counts as answered")
    {
        expected = ERule::AckTransaction;
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 99));
    }
    SECTION("another command")
    {
        expected = ERule::AckCommand;
        fixture.Received(JudgeFixture::MakeAck("StepReport", 3));
    }
    SECTION("unknown result")
    {
        expected = ERule::AckResult;
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3, "Done"));
    }
    SECTION("a valid report is refused")
    {
        expected = ERule::ReportAccepted;
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 3, "Fail"));
    }
    fixture.Wait(LONG);
    CHECK(fixture.GetViolated() == Rules{expected});
}

TEST_CASE("6.1 The command of an Ack in another case is a violation, and the request counts as answered")
{
    JudgeFixture fixture;
    fixture.Sent(JudgeFixture::MakeRequest("Registration", 1, "{}"));
    std::string registrationAck = JudgeFixture::MakeAck("Registration", 1);
    registrationAck.replace(registrationAck.find("Ack"), 3, "ACK");
    fixture.Received(registrationAck);
    CHECK(fixture.GetViolated() == Rules{ERule::AckCommand});
    fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 2, JudgeFixture::PLAN));
    fixture.Sent(JudgeFixture::MakeAck("ExecutionPlan", 2));
    fixture.Sent(JudgeFixture::MakeRequest("PlanReport", 3, JudgeFixture::REPORT));
    std::string reportAck = JudgeFixture::MakeAck("planreport", 3);
    reportAck.replace(reportAck.find("Ack"), 3, "ack");
    fixture.Received(reportAck);
    fixture.Wait(LONG);
    CHECK(fixture.GetViolated() == Rules{ERule::AckCommand});
    CHECK(fixture.judge.GetBook().GetRow(ERule::AckCommand).violated == 2);
    // Ack alone is no Ack of anything.
    fixture.Received(JudgeFixture::MakeAck("", 4));
    CHECK(fixture.judge.GetBook().GetRow(ERule::KnownCommand).violated == 1);
}

TEST_CASE("D-2 The result of an Ack may have any case")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Ask("PlanReport", 3, JudgeFixture::REPORT, "success");
    CHECK(fixture.GetViolated().empty());
}

TEST_CASE("6.1 A report about an unknown plan, and one that is excused, may be refused")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Ask("PlanReport", 3, R"({"planId":"Q","status":"InProgress","message":""})", "Fail");
    fixture.judge.Excuse(JudgeFixture::MakeID(4));
    CHECK(fixture.judge.ListOpenRequests().empty());
    fixture.Ask("PlanReport", 4, JudgeFixture::REPORT, "Fail");
    CHECK(fixture.GetViolated().empty());
}

TEST_CASE("6.1 A repeated report has an Ack each time, with the same result")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Ask("PlanReport", 3, JudgeFixture::REPORT);
    fixture.Ask("PlanReport", 3, JudgeFixture::REPORT);
    CHECK(fixture.GetViolated().empty());
    CHECK(fixture.WasKept(ERule::ReportRepeated));
    fixture.Ask("PlanReport", 3, JudgeFixture::REPORT, "Fail");
    CHECK(fixture.GetViolated() == Rules{ERule::ReportAccepted, ERule::ReportRepeated});
}

TEST_CASE("6.1, 6.2 After a reconnect the Registration and repeated reports are answered")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Sent(JudgeFixture::MakeRequest("PlanReport", 3, JudgeFixture::REPORT));
    fixture.judge.OnClosed(false);
    CHECK(fixture.judge.ListOpenRequests().empty());
    fixture.Wait(LONG);
    CHECK(fixture.GetViolated().empty());
    SECTION("correct")
    {
        fixture.Register(10);
        fixture.Ask("PlanReport", 3, JudgeFixture::REPORT);
        fixture.Wait(LONG);
        CHECK(fixture.GetViolated().empty());
        CHECK(fixture.WasKept(ERule::Reconnected));
        CHECK(fixture.WasKept(ERule::ReportAfterReconnect));
    }
    SECTION("the reports are forgotten")
    {
        fixture.Register(10);
        fixture.Ask("PlanReport", 3, JudgeFixture::REPORT, "Fail");
        CHECK(fixture.GetViolated() == Rules{ERule::ReportAfterReconnect});
    }
    SECTION("the Registration is not answered")
    {
        fixture.Sent(JudgeFixture::MakeRequest("Registration", 10, "{}"));
        fixture.Wait(LONG);
        CHECK(fixture.GetViolated() == Rules{ERule::Reconnected});
    }
}

TEST_CASE("6.1 Undefined payloads and unknown commands are answered with Fail")
{
    JudgeFixture fixture;
    fixture.Begin();
    const auto& [rule, command] = GENERATE(
        std::pair<ERule, std::string_view>{ERule::UndefinedPayload, "PlanReport"},
        std::pair<ERule, std::string_view>{ERule::UnknownCommand, "Dance"});
    fixture.Ask(command, 3, "{}", "Fail");
    CHECK(fixture.GetViolated().empty());
    CHECK(fixture.WasKept(rule));
    SECTION("Success")
    {
        fixture.Ask(command, 4, "{}");
    }
    SECTION("nothing")
    {
        fixture.Sent(JudgeFixture::MakeRequest(command, 4, "{}"));
        fixture.Wait(LONG);
    }
    CHECK(fixture.GetViolated() == Rules{rule});
}

TEST_CASE("6.1 After a text that is not JSON the connection stays and the MCS answers")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Sent(JudgeFixture::MakeRequest("TscStateUpdate", 3, JudgeFixture::STATE));
    fixture.Sent("{");
    fixture.Received(JudgeFixture::MakeAck("TscStateUpdate", 3)); // Sent before the malformed text: proves nothing.
    CHECK_FALSE(fixture.WasKept(ERule::MalformedText));
    fixture.Sent(JudgeFixture::MakeRequest("PlanReport", 4, JudgeFixture::REPORT));
    SECTION("correct")
    {
        fixture.Received(JudgeFixture::MakeAck("PlanReport", 4));
        fixture.judge.OnClosed(false);
        CHECK(fixture.GetViolated().empty());
        CHECK(fixture.WasKept(ERule::MalformedText));
    }
    SECTION("the connection is lost")
    {
        fixture.judge.OnClosed(false);
        CHECK(fixture.GetViolated() == Rules{ERule::MalformedText});
    }
    SECTION("the MCS is silent")
    {
        fixture.Wait(LONG);
        CHECK(fixture.GetViolated() == Rules{ERule::MalformedText});
    }
    SECTION("the ACS ends the connection")
    {
        fixture.judge.OnClosed(true);
        CHECK(fixture.GetViolated().empty());
    }
}

TEST_CASE("6.19 A position is not answered")
{
    JudgeFixture fixture;
    fixture.Begin();
    fixture.Sent(JudgeFixture::MakeRequest("RobotPositionUpdate", 3, R"({"robots":[]})"));
    fixture.Wait(LONG);
    CHECK(fixture.GetViolated().empty());
    fixture.Received(JudgeFixture::MakeAck("RobotPositionUpdate", 3));
    CHECK(fixture.GetViolated() == Rules{ERule::PositionUnanswered});
}

TEST_CASE("6.21 No plan comes after the Ack of isConnected=false")
{
    JudgeFixture fixture;
    fixture.Register();
    fixture.Sent(JudgeFixture::MakeRequest("AcsCommStateUpdate", 3, R"({"isConnected":false})"));
    fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 2, JudgeFixture::PLAN)); // Under way before.
    fixture.Received(JudgeFixture::MakeAck("AcsCommStateUpdate", 3));
    CHECK(fixture.GetViolated().empty());
    std::string other(JudgeFixture::PLAN);
    other.replace(other.find("\"P\""), 3, "\"Q\"");
    SECTION("while it is false")
    {
        fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 4, other));
        CHECK(fixture.GetViolated() == Rules{ERule::PlansWithheld});
    }
    SECTION("the Ack of false comes after true was sent")
    {
        fixture.Sent(JudgeFixture::MakeRequest("AcsCommStateUpdate", 5, R"({"isConnected":false})"));
        fixture.Sent(JudgeFixture::MakeRequest("AcsCommStateUpdate", 6, R"({"isConnected":true})"));
        fixture.Received(JudgeFixture::MakeAck("AcsCommStateUpdate", 5));
        fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 4, other));
        CHECK(fixture.GetViolated().empty());
    }
    SECTION("after it is true again")
    {
        fixture.Ask("AcsCommStateUpdate", 5, R"({"isConnected":true})");
        fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 4, other));
        CHECK(fixture.GetViolated().empty());
        CHECK(fixture.WasKept(ERule::PlansWithheld));
    }
}

TEST_CASE("6.4 A refused plan may come again, and has no controls")
{
    JudgeFixture fixture;
    fixture.Register();
    fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 2, JudgeFixture::PLAN));
    fixture.Sent(JudgeFixture::MakeAck("ExecutionPlan", 2, "Fail"));
    SECTION("again")
    {
        fixture.Received(JudgeFixture::MakeRequest("ExecutionPlan", 3, JudgeFixture::PLAN));
        CHECK(fixture.GetViolated().empty());
    }
    SECTION("control")
    {
        fixture.Received(JudgeFixture::MakeRequest("CancelPlan", 3, R"({"planId":"P","reason":""})"));
        CHECK(fixture.GetViolated() == Rules{ERule::ControlOfKnownPlan});
    }
}

TEST_CASE("Each violation is a line once, and the table has the first")
{
    JudgeFixture fixture;
    fixture.Register();
    fixture.Received("no");
    fixture.Received("again");
    const std::vector<std::string> news = fixture.judge.GetBook().ExtractNews();
    CHECK(
        news
        == std::vector<std::string>{"json (6): not a JSON object: \"no\"", "json (6): not a JSON object: \"again\""});
    CHECK(fixture.judge.GetBook().ExtractNews().empty());
    CHECK(fixture.judge.GetBook().GetRow(ERule::JsonObject).first == "not a JSON object: \"no\"");
}

TEST_CASE("The judge survives any bytes of the MCS and forgets old transactions")
{
    JudgeFixture fixture;
    fixture.Begin();
    ACS::Testing::SeededRandom random;
    const std::string valid = JudgeFixture::MakeRequest("ExecutionPlan", 9, JudgeFixture::PLAN);
    for (int round = 0; round < 5000; ++round)
    {
        std::string text = valid;
        for (int change = 0; change < 3; ++change)
        {
            text[random.GetNext() % text.size()] = static_cast<char>(random.GetNext());
        }
        fixture.Received(text);
        fixture.Ask("TscStateUpdate", 1000 + round, JudgeFixture::STATE);
    }
    CHECK(fixture.judge.GetBook().IsViolated());
    CHECK(fixture.judge.GetBook().ExtractNews().size() <= 20 * ACS::AcsSim::RULE_COUNT);
    CHECK(fixture.judge.ListOpenRequests().empty());
}

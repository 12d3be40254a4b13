#include "wire/NoteJudge.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS::McsSim; // NOLINT(google-build-using-namespace)
using ACS::Protocol::EProtocolNote;

TEST_CASE(
    "R1, R2, 6.1 A broken rule is a violation each time; a deviation that the document tolerates is reported once")
{
    NoteJudge judge;
    const auto fault = GENERATE(
        EProtocolNote::Undecodable,
        EProtocolNote::UnknownCommand,
        EProtocolNote::BadTimestamp,
        EProtocolNote::AckMismatched,
        EProtocolNote::AckUnexpected,
        EProtocolNote::BeforeRegistered);
    for (int i = 0; i < 2; ++i)
    {
        const auto verdict = judge.JudgeOrNull({fault, 1, "Dance"});
        REQUIRE(verdict.has_value());
        CHECK(verdict->bViolation);
        CHECK(verdict->text == "ACS " + std::string(GetMeaning(fault)) + ": Dance");
    }
    const auto tolerated = GENERATE(
        EProtocolNote::UnknownMember,
        EProtocolNote::NullOptional,
        EProtocolNote::LenientWord,
        EProtocolNote::LenientNumber);
    const auto first = judge.JudgeOrNull({tolerated, 3, ""});
    REQUIRE(first.has_value());
    CHECK_FALSE(first->bViolation);
    CHECK_FALSE(judge.JudgeOrNull({tolerated, 1, ""}).has_value());
    CHECK(judge.GetCounts()[static_cast<std::size_t>(tolerated)] == 4);
    CHECK(judge.GetCounts()[static_cast<std::size_t>(fault)] == 2);
}

TEST_CASE("Notes that only an ACS makes, and what the public MCS does not know, are not violations")
{
    NoteJudge judge;
    CHECK_FALSE(judge.JudgeOrNull({EProtocolNote::AckFailed, 1, "no"}).has_value());
    CHECK_FALSE(judge.JudgeOrNull({EProtocolNote::DuplicateRequest, 1, "PlanReport"}).has_value());
    CHECK_FALSE(judge.JudgeOrNull({EProtocolNote::RegistrationUnanswered, 1, ""}).has_value());
    CHECK_FALSE(judge.JudgeOrNull({EProtocolNote::UnknownCommand, 1, "RobotPositionUpdate"}).has_value());
    CHECK(judge.GetCounts() == NoteCounts{});
}

TEST_CASE("The Ack of a text that went past the session is excused once, where the text can be answered")
{
    struct Row
    {
        std::string text;
        bool bAnswerable;
    };
    const auto row = GENERATE(
        Row{R"({"command":"Dance","transactionId":"x","timestamp":"2025-07-02T21:00:00Z","payload":{}})", true},
        Row{R"({"command":"RequestAcsPlans","transactionId":"x","timestamp":"2025-07-02T21:00:00Z","payload":{}})",
            true},
        Row{R"({"command":"ExecutionPlan","transactionId":"x"})", true},
        Row{"this is no JSON", false},
        Row{R"({"transactionId":"x"})", false},
        Row{R"({"command":"StepReportAck","transactionId":"x","timestamp":"2025-07-02T21:00:00Z","result":"Success","message":"","payload":{}})",
            false});
    CAPTURE(row.text);
    NoteJudge judge;
    judge.OnTextSent(row.text);
    CHECK(judge.JudgeOrNull({EProtocolNote::BeforeRegistered, 1, ""})->bViolation);
    CHECK(judge.JudgeOrNull({EProtocolNote::AckUnexpected, 1, "Dance"})->bViolation == !row.bAnswerable);
    CHECK(judge.JudgeOrNull({EProtocolNote::AckUnexpected, 1, "Dance"})->bViolation);
    CHECK(judge.GetCounts()[static_cast<std::size_t>(EProtocolNote::AckUnexpected)] == (row.bAnswerable ? 1 : 2));
}

TEST_CASE("An excuse that is withdrawn hides no fault, and none that came before it")
{
    NoteJudge judge;
    judge.WithdrawExcuse();
    judge.Excuse();
    judge.Excuse();
    judge.WithdrawExcuse();
    CHECK_FALSE(judge.JudgeOrNull({EProtocolNote::AckUnexpected, 1, "CancelPlan"})->bViolation);
    CHECK(judge.JudgeOrNull({EProtocolNote::AckUnexpected, 1, "CancelPlan"})->bViolation);
}

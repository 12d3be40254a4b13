#include "wire/TimestampJudge.hpp"

#include "Catch.hpp"
#include "RunJudge.hpp"

#include <string>
#include <vector>

using ACS::McsSim::ETimestampDeviation;
using ACS::McsSim::TimestampCounts;
using ACS::McsSim::TimestampJudge;

namespace
{

std::string MakeText(const std::string& timestamp)
{
    return R"({"command":"TscStateUpdate","transactionId":"x","timestamp":")" + timestamp
        + R"(","payload":{"state":"Auto"}})";
}

} // namespace

TEST_CASE("R19 A timestamp in another form than the document's is reported once per deviation")
{
    struct Row
    {
        std::string timestamp;
        std::vector<ETimestampDeviation> deviations;
    };
    const auto row = GENERATE(
        Row{"2025-07-02T21:00:00.123+09:00", {}},
        Row{"2025-07-02T21:00:00.123-03:30", {}},
        Row{"2025-07-02T21:00:00.123", {ETimestampDeviation::NoOffset}},
        Row{"2025-07-02T12:00:00.123Z", {ETimestampDeviation::Utc}},
        Row{"2025-07-02T21:00:00+09:00", {ETimestampDeviation::Fraction}},
        Row{"2025-07-02T21:00:00.1234567+09:00", {ETimestampDeviation::Fraction}},
        Row{"2025-07-02T21:00:00.123+0900", {ETimestampDeviation::OtherSpelling}},
        Row{"2025-07-02t12:00:00z",
            {ETimestampDeviation::Fraction, ETimestampDeviation::Utc, ETimestampDeviation::OtherSpelling}});
    CAPTURE(row.timestamp);
    TimestampJudge judge;
    std::vector<std::string> expected;
    TimestampCounts counts{};
    for (const ETimestampDeviation deviation : row.deviations)
    {
        expected.push_back("ACS " + std::string(GetMeaning(deviation)) + ": " + row.timestamp + " (reported once)");
        counts[static_cast<std::size_t>(deviation)] = 2;
    }
    CHECK(judge.OnText(MakeText(row.timestamp)) == expected);
    CHECK(judge.OnText(MakeText(row.timestamp)).empty());
    CHECK(judge.GetCounts() == counts);
}

TEST_CASE("6.1 A text without a readable timestamp has no deviation: the codec notes it")
{
    TimestampJudge judge;
    for (const char* const text : {"this is no JSON", "[]", R"({"timestamp":7})", R"({"command":"Dance"})"})
    {
        CHECK(judge.OnText(text).empty());
    }
    CHECK(judge.OnText(MakeText("yesterday")).empty());
    CHECK(judge.GetCounts() == TimestampCounts{});
}

TEST_CASE("R19 A timestamp without offset is a deviation of the run, and no violation")
{
    ACS::McsSim::PlanTracker::Lines lines;
    ACS::McsSim::RunJudge judge{ACS::McsSim::SimulatorOptions{}, {}, lines};
    judge.OnTextReceived(MakeText("2025-07-02T21:00:00.123"));
    CHECK(lines.size() == 1);
    CHECK(judge.GetTracker().CountViolations() == 0);
    CHECK(judge.GetTimestampCounts().front() == 1);
}

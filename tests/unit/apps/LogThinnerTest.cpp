#include "common/LogThinner.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

using namespace ACS; // NOLINT(google-build-using-namespace): a test of several of them
using namespace std::chrono_literals;
using Apps::LogThinner;

namespace
{

class Flood
{
public:
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    LogThinner thinner{Core::Logger(sink, "x")};

    void Write(const std::string& kind, const std::string& message = "bad")
    {
        thinner.Write(clock.GetNow().steady, Core::ELogLevel::Warning, kind, message, {{"kind", kind}});
    }

    [[nodiscard]] std::size_t CountLines() const
    {
        return sink.GetLines().size();
    }
};

} // namespace

TEST_CASE("Of a flood the first few lines are told, then one per interval with the count of those left out")
{
    Flood flood;
    for (int second = 0; second < 200; ++second)
    {
        flood.Write("a");
        flood.clock.Advance(1s);
    }
    const auto& lines = flood.sink.GetLines();
    REQUIRE(lines.size() == 8); // 0 to 4 s, then 64, 124 and 184 s
    CHECK(lines[4].message == "bad");
    CHECK(lines[5].message == "bad (59 like it left out before)");
    CHECK(lines[7].message == "bad (59 like it left out before)");
    CHECK(lines[7].HasField("kind", "a"));
    CHECK(lines[7].level == Core::ELogLevel::Warning);
}

TEST_CASE("What comes now and then is told each time, and a flood that has ended begins anew")
{
    Flood flood;
    for (int minute = 0; minute < 20; ++minute)
    {
        flood.Write("a");
        flood.clock.Advance(LogThinner::INTERVAL);
    }
    CHECK(flood.CountLines() == 20);
    for (int count = 0; count < 100; ++count)
    {
        flood.Write("a");
    }
    CHECK(flood.CountLines() == 25);
    flood.clock.Advance(LogThinner::INTERVAL);
    flood.Write("a");
    CHECK(flood.sink.GetLines().back().message == "bad (95 like it left out before)");
    flood.Write("a");
    CHECK(flood.CountLines() == 27);
}

TEST_CASE("One kind does not hide another, and a flood of kinds fills neither memory nor log")
{
    Flood flood;
    for (int count = 0; count < 100; ++count)
    {
        flood.Write("a");
    }
    flood.Write("b");
    CHECK(flood.CountLines() == LogThinner::FEW + 1);
    flood.sink.Clear();
    for (int count = 0; count < 100'000; ++count)
    {
        flood.Write("kind " + std::to_string(count));
    }
    CHECK(flood.CountLines() < LogThinner::MOST_KINDS + 2 * LogThinner::FEW);
    flood.clock.Advance(LogThinner::INTERVAL);
    flood.sink.Clear();
    flood.Write("another");
    CHECK(flood.CountLines() == 1);
}

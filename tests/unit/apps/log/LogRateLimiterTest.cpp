#include "common/log/LogRateLimiter.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

using namespace ACS; // NOLINT(google-build-using-namespace): a test of several of them
using namespace std::chrono_literals;
using Apps::LogRateLimiter;

namespace
{

class Flood
{
public:
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    LogRateLimiter limiter{Core::Logger(sink, "x")};

    void Write(const std::string& kind, const std::string& message = "bad")
    {
        limiter.Write(clock.GetNow().steady, Core::ELogLevel::Warning, kind, message, {{"kind", kind}});
    }

    [[nodiscard]] std::size_t CountLines() const
    {
        return sink.GetLines().size();
    }
};

} // namespace

TEST_CASE("A flood of similar lines gives a burst, then one line per interval with the number of suppressed lines")
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
    CHECK(lines[5].message == "bad (59 similar lines suppressed)");
    CHECK(lines[7].message == "bad (59 similar lines suppressed)");
    CHECK(lines[7].HasField("kind", "a"));
    CHECK(lines[7].level == Core::ELogLevel::Warning);
}

TEST_CASE("Occasional lines are all written, and a flood after a silent interval gets a new burst")
{
    Flood flood;
    for (int minute = 0; minute < 20; ++minute)
    {
        flood.Write("a");
        flood.clock.Advance(LogRateLimiter::INTERVAL);
    }
    CHECK(flood.CountLines() == 20);
    for (int count = 0; count < 100; ++count)
    {
        flood.Write("a");
    }
    CHECK(flood.CountLines() == 25);
    flood.clock.Advance(LogRateLimiter::INTERVAL);
    flood.Write("a");
    CHECK(flood.sink.GetLines().back().message == "bad (95 similar lines suppressed)");
    flood.Write("a");
    CHECK(flood.CountLines() == 27);
}

TEST_CASE("One kind does not suppress another, and a flood of kinds fills neither memory nor log")
{
    Flood flood;
    for (int count = 0; count < 100; ++count)
    {
        flood.Write("a");
    }
    flood.Write("b");
    CHECK(flood.CountLines() == LogRateLimiter::BURST + 1);
    flood.sink.Clear();
    for (int count = 0; count < 100'000; ++count)
    {
        flood.Write("kind " + std::to_string(count));
    }
    CHECK(flood.CountLines() < LogRateLimiter::MAX_KINDS + 2 * LogRateLimiter::BURST);
    flood.clock.Advance(LogRateLimiter::INTERVAL);
    flood.sink.Clear();
    flood.Write("another");
    CHECK(flood.CountLines() == 1);
}

TEST_CASE("Kinds that were suppressed once give way to others when they are silent")
{
    Flood flood;
    for (std::size_t kind = 0; kind < LogRateLimiter::MAX_KINDS; ++kind)
    {
        for (std::size_t line = 0; line <= LogRateLimiter::BURST; ++line)
        {
            flood.Write("kind " + std::to_string(kind));
        }
    }
    flood.clock.Advance(LogRateLimiter::INTERVAL);
    flood.sink.Clear();
    for (std::size_t kind = 0; kind < 2 * LogRateLimiter::BURST; ++kind)
    {
        flood.Write("other kind " + std::to_string(kind));
    }
    CHECK(flood.CountLines() == 2 * LogRateLimiter::BURST);
}

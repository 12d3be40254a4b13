#include "store/StoreWatch.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include <acs/core/ECoreError.hpp>

namespace ACS::Acsd::Test
{

using namespace std::chrono_literals;

TEST_CASE("A write that takes too long is logged and is a not-ready reason until it ends")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    StoreWatch watch{Core::Logger(sink, "store")};
    watch.OnBegun(clock.GetNow().steady);
    CHECK_FALSE(watch.GetFaultOrNull().has_value());
    clock.Advance(StoreWatch::LIMIT);
    watch.OnLate();
    CHECK(watch.GetFaultOrNull() == std::string("the store does not answer"));
    CHECK(sink.Contains(Core::ELogLevel::Error, "the store does not answer"));
    clock.Advance(2s);
    CHECK(watch.OnStored({}, clock.GetNow().steady) == StoreWatch::LIMIT + 2s);
    CHECK_FALSE(watch.GetFaultOrNull().has_value());
    CHECK(sink.ContainsField("after", "7 s"));
    watch.OnBegun(clock.GetNow().steady);
    CHECK(watch.OnStored({}, clock.GetNow().steady) == Core::Duration::zero());
    CHECK(sink.CountLevel(Core::ELogLevel::Warning) == 1);
}

TEST_CASE("A failed write is a not-ready reason until one succeeds")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    StoreWatch watch{Core::Logger(sink, "store")};
    watch.OnBegun(clock.GetNow().steady);
    watch.OnStored(Core::Fail(Core::ECoreError::TooLarge, "acsd.db", "room", "disk full"), clock.GetNow().steady);
    CHECK(
        watch.GetFaultOrNull() == std::string("the store cannot be written: acsd.db: expected room, found disk full"));
    CHECK(sink.Contains(Core::ELogLevel::Error, "the store fails"));
    CHECK(sink.ContainsField("reason", "acsd.db: expected room, found disk full"));
    watch.OnStored({}, clock.GetNow().steady);
    CHECK_FALSE(watch.GetFaultOrNull().has_value());
    CHECK(sink.Contains(Core::ELogLevel::Warning, "the store works again"));
}

TEST_CASE("A store that fails each second is logged a few times, then once a minute, and each new reason at once")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    StoreWatch watch{Core::Logger(sink, "store")};
    const auto fail = [&](const char* reason) {
        watch.OnStored(Core::Fail(Core::ECoreError::TooLarge, "acsd.db", "room", reason), clock.GetNow().steady);
        clock.Advance(1s);
    };
    for (int second = 0; second < 130; ++second)
    {
        fail("disk full");
    }
    CHECK(sink.GetLines().size() == 7);
    CHECK(sink.Contains(Core::ELogLevel::Error, "the store fails (59 similar lines suppressed)"));
    fail("disk broken");
    CHECK(sink.GetLines().size() == 8);
    CHECK(sink.ContainsField("reason", "acsd.db: expected room, found disk broken"));
}

TEST_CASE("A missing file is a not-ready reason without a write, until a write succeeds")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    StoreWatch watch{Core::Logger(sink, "store")};
    watch.OnLost({Core::ECoreError::OutOfRange, "acsd.db", "the file", "nothing"}, clock.GetNow().steady);
    CHECK(
        watch.GetFaultOrNull()
        == std::string("the store cannot be written: acsd.db: expected the file, found nothing"));
    CHECK(sink.Contains(Core::ELogLevel::Error, "the store fails"));
    watch.OnBegun(clock.GetNow().steady);
    watch.OnStored({}, clock.GetNow().steady);
    CHECK_FALSE(watch.GetFaultOrNull().has_value());
}

} // namespace ACS::Acsd::Test

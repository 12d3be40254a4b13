#include "Catch.hpp"
#include "ManualClock.hpp"
#include <acs/core/Timestamp.hpp>

#include <array>

using ACS::Core::ECoreError;
using ACS::Core::FormatLocal;
using ACS::Core::FormatUTC;
using ACS::Core::ParseTimestamp;
using ACS::Core::Result;
using ACS::Core::Timestamp;
using ACS::Core::WallTime;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::nanoseconds;

namespace
{

WallTime GetNoon()
{
    return ACS::Testing::ManualClock().GetNow().wall;
}

struct Accepted
{
    std::string_view text;
    nanoseconds behindNoon; ///< After 2025-07-02T12:00:00Z.
    minutes offset;
};

} // namespace

TEST_CASE("2 A timestamp is accepted with any fraction and any form of offset")
{
    const std::array<Accepted, 13> cases{{
        {"2025-07-02T21:00:00.123+09:00", milliseconds(123), minutes(540)},
        {"2025-07-02T12:00:00.123Z", milliseconds(123), minutes(0)},
        {"2025-07-02T12:00:00Z", nanoseconds(0), minutes(0)},
        {"2025-07-02t12:00:00z", nanoseconds(0), minutes(0)},
        {"2025-07-02T21:00:00+0900", nanoseconds(0), minutes(540)},
        {"2025-07-02T21:00:00.1234567+09:00", nanoseconds(123'456'700), minutes(540)},
        {"2025-07-02T12:00:00.1Z", milliseconds(100), minutes(0)},
        {"2025-07-02T12:00:00.000000001Z", nanoseconds(1), minutes(0)},
        {"2025-07-02T12:00:00.999999999Z", nanoseconds(999'999'999), minutes(0)},
        {"2025-07-02T08:30:00-03:30", nanoseconds(0), minutes(-210)},
        {"2025-07-03T00:00:00+12:00", nanoseconds(0), minutes(720)},
        {"2025-07-02T14:00:00", nanoseconds(0), minutes(120)},
        {"2025-07-02T14:00:00.25", milliseconds(250), minutes(120)},
    }};
    for (const Accepted& accepted : cases)
    {
        INFO(accepted.text);
        const Result<Timestamp> timestamp = ParseTimestamp(accepted.text, minutes(120));
        REQUIRE(timestamp.has_value());
        CHECK((timestamp->time == GetNoon() + accepted.behindNoon));
        CHECK((timestamp->offset == accepted.offset));
    }
}

TEST_CASE("2 A timestamp out of range or of another form is refused")
{
    for (const std::string_view text :
         {"",
          "2025-07-02",
          "2025-07-02T12:00",
          "2025-07-02 12:00:00Z",
          "2025-7-02T12:00:00Z",
          "2025-00-02T12:00:00Z",
          "2025-13-02T12:00:00Z",
          "2025-07-00T12:00:00Z",
          "2025-07-32T12:00:00Z",
          "2025-06-31T12:00:00Z",
          "2025-02-29T12:00:00Z",
          "1900-02-29T12:00:00Z",
          "2025-07-02T24:00:00Z",
          "2025-07-02T12:60:00Z",
          "2025-07-02T12:00:60Z",
          "2025-07-02T12:00:00.Z",
          "2025-07-02T12:00:00.1234567890Z",
          "2025-07-02T12:00:00,5Z",
          "2025-07-02T12:00:00+24:00",
          "2025-07-02T12:00:00+09:60",
          "2025-07-02T12:00:00+09",
          "2025-07-02T12:00:00+9:00",
          "2025-07-02T12:00:00Zjunk",
          "2025-07-02T12:00:00Z ",
          " 2025-07-02T12:00:00Z",
          "-025-07-02T12:00:00Z",
          "0001-01-01T00:00:00",
          "1677-12-31T23:59:59Z",
          "2262-01-01T00:00:00Z"})
    {
        INFO(text);
        const Result<Timestamp> timestamp = ParseTimestamp(text);
        REQUIRE_FALSE(timestamp.has_value());
        CHECK(timestamp.error().code == ECoreError::InvalidTimestamp);
    }
}

TEST_CASE("2 Leap days are valid dates")
{
    CHECK(FormatUTC(ParseTimestamp("2024-02-29T00:00:00Z").value().time) == "2024-02-29T00:00:00.000Z");
    CHECK(FormatUTC(ParseTimestamp("2000-02-29T00:00:00Z").value().time) == "2000-02-29T00:00:00.000Z");
    CHECK(
        FormatUTC(ParseTimestamp("2024-02-28T23:59:59Z").value().time + std::chrono::seconds(1))
        == "2024-02-29T00:00:00.000Z");
}

TEST_CASE("2 The first and the last year do not overflow")
{
    CHECK(FormatUTC(ParseTimestamp("1678-01-01T00:00:00+23:59").value().time) == "1677-12-31T00:01:00.000Z");
    CHECK(FormatUTC(ParseTimestamp("2261-12-31T23:59:59.999-23:59").value().time) == "2262-01-01T23:58:59.999Z");
}

TEST_CASE("2 Timestamps of MCS-ACS have local time with offset and milliseconds")
{
    CHECK(FormatLocal(GetNoon() + milliseconds(123), minutes(540)) == "2025-07-02T21:00:00.123+09:00");
    CHECK(FormatLocal(GetNoon(), minutes(0)) == "2025-07-02T12:00:00.000+00:00");
    CHECK(FormatLocal(GetNoon(), minutes(-210)) == "2025-07-02T08:30:00.000-03:30");
    CHECK(FormatLocal(GetNoon() + hours(12), minutes(540)) == "2025-07-03T09:00:00.000+09:00");
}

TEST_CASE("VDA5050 6.1 Timestamps of VDA5050 have UTC with milliseconds")
{
    CHECK(FormatUTC(GetNoon() + milliseconds(123)) == "2025-07-02T12:00:00.123Z");
    CHECK(FormatUTC(GetNoon() + nanoseconds(999'999)) == "2025-07-02T12:00:00.000Z");
    CHECK(FormatUTC(WallTime() - nanoseconds(1)) == "1969-12-31T23:59:59.999Z");
}

TEST_CASE("2 A formatted timestamp is parsed to the same time")
{
    for (const minutes offset : {minutes(540), minutes(-570), minutes(0), minutes(1'439), minutes(-1'439)})
    {
        const WallTime time = GetNoon() + milliseconds(7);
        CHECK((ParseTimestamp(FormatLocal(time, offset)).value() == Timestamp{time, offset}));
    }
}

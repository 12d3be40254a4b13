#include "common/config/LocalOffset.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>

namespace Apps = ACS::Apps;
namespace Testing = ACS::Testing;

TEST_CASE("A fixed offset is the same at all times")
{
    using Row = std::pair<const char*, int>;
    const auto [text, minutes] =
        GENERATE(Row{"Z", 0}, Row{"+09:00", 540}, Row{"-03:30", -210}, Row{"+14:00", 840}, Row{"-12:00", -720});
    const auto offset = Apps::LocalOffset::Parse(text);
    REQUIRE(offset.has_value());
    REQUIRE(offset->GetAt(Testing::ManualClock().GetNow().wall) == std::chrono::minutes(minutes));
}

TEST_CASE("An invalid offset is refused")
{
    const auto* const text =
        GENERATE("", "+9:00", "09:00", "+0900", "+09:60", "+14:01", "-12:01", "+-9:00", "+09:-1", "local", "+09:0x");
    CAPTURE(text);
    REQUIRE_FALSE(Apps::LocalOffset::Parse(text).has_value());
}

TEST_CASE("The offset of the system includes daylight saving time")
{
    const char* const zoneOrNull = std::getenv("TZ");
    const std::string zone = zoneOrNull != nullptr ? zoneOrNull : "";
    // A POSIX rule, which needs no time zone database.
    setenv("TZ", "CET-1CEST,M3.5.0,M10.5.0/3", 1);
    tzset();
    Testing::ManualClock clock;
    const auto summer = Apps::LocalOffset().GetAt(clock.GetNow().wall);
    clock.JumpWall(std::chrono::hours(24 * 180));
    const auto winter = Apps::LocalOffset().GetAt(clock.GetNow().wall);
    zoneOrNull != nullptr ? setenv("TZ", zone.c_str(), 1) : unsetenv("TZ");
    tzset();
    REQUIRE(summer == std::chrono::minutes(120));
    REQUIRE(winter == std::chrono::minutes(60));
}

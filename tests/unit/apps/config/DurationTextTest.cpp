#include "common/config/DurationText.hpp"

#include "Catch.hpp"

#include <chrono>
#include <utility>

namespace Apps = ACS::Apps;

TEST_CASE("A duration is a whole number and its unit")
{
    using Row = std::pair<const char*, std::chrono::milliseconds>;
    const auto [text, duration] = GENERATE(
        Row{"200ms", 200},
        Row{"5s", 5'000},
        Row{"2m", 120'000},
        Row{"1h", 3'600'000},
        Row{"0s", 0},
        Row{"8784h", 31'622'400'000});
    REQUIRE(Apps::ParseDuration(text) == duration);
}

TEST_CASE("An invalid duration is refused")
{
    const auto* const text =
        GENERATE("", "5", "s", "5 s", "5S", "-5s", "+5s", "1.5s", "5s ", "5min", "8785h", "99999999999s", "0x5s");
    CAPTURE(text);
    REQUIRE_FALSE(Apps::ParseDuration(text).has_value());
}

TEST_CASE("A duration is written in the largest unit that shows it exactly")
{
    REQUIRE(Apps::MakeDurationText(std::chrono::minutes(90)) == "90m");
    REQUIRE(Apps::MakeDurationText(std::chrono::hours(2)) == "2h");
    REQUIRE(Apps::MakeDurationText(std::chrono::milliseconds(1'500)) == "1500ms");
    REQUIRE(Apps::MakeDurationText(std::chrono::milliseconds(0)) == "0ms");
}

#include "view/AgeText.hpp"

#include "Catch.hpp"
#include <acs/core/Timestamp.hpp>

#include <chrono>

namespace Acsctl = ACS::Acsctl;
using namespace std::chrono_literals;

TEST_CASE("A duration has at most two units")
{
    CHECK(Acsctl::MakeDurationText(-5s) == "0 s");
    CHECK(Acsctl::MakeDurationText(59s) == "59 s");
    CHECK(Acsctl::MakeDurationText(60s) == "1 min");
    CHECK(Acsctl::MakeDurationText(3'599s) == "59 min");
    CHECK(Acsctl::MakeDurationText(3'600s) == "1 h 0 min");
    CHECK(Acsctl::MakeDurationText(47h + 59min) == "47 h 59 min");
    CHECK(Acsctl::MakeDurationText(48h) == "2 d");
}

TEST_CASE("An age needs a time that can be read")
{
    const auto now = ACS::Core::ParseTimestamp("2026-11-27T23:10:00.000Z")->time;
    CHECK(Acsctl::MakeAge("2026-11-27T23:09:18.500Z", now) == "41 s");
    CHECK(Acsctl::MakeAge(std::nullopt, now) == "-");
    CHECK(Acsctl::MakeAge("yesterday", now) == "-");
    CHECK(Acsctl::MakeAge("2026-11-27T23:11:00Z", now) == "0 s");
    CHECK(Acsctl::MakeSince("2026-11-27T23:08:00Z", now) == " for 2 min");
    CHECK(Acsctl::MakeSince(std::nullopt, now).empty());
}

TEST_CASE("The time of day is cut from a time that can be read")
{
    CHECK(Acsctl::MakeTimeOfDay("2026-11-27T23:09:18.500Z") == "23:09:18.500");
    CHECK(Acsctl::MakeTimeOfDay("2026-11-27T23:09:18.500+09:00") == "23:09:18.500");
    CHECK(Acsctl::MakeTimeOfDay("odd") == "odd");
    CHECK(Acsctl::MakeTimeOfDay("").empty());
}

#include "Catch.hpp"
#include <acs/core/LocationMap.hpp>

#include <string>
#include <vector>

using ACS::Core::ECoreError;
using ACS::Core::Location;
using ACS::Core::LocationMap;
using ACS::Core::Result;
using ACS::Core::RobotID;

namespace
{

Location MakeKey(std::string_view text)
{
    return Location::Parse(text).value();
}

/// The reference map of section 8.1 and a second area whose sets have gaps in their numbers.
LocationMap MakeMap()
{
    const std::vector<std::string> ranges{
        "ST01.CP01-06",
        "A01.CP01-06",
        "A01.CP01.TP01-04",
        "A01.SET01-12",
        "A01.SET01.MP01-32",
        "A01.SET02.MP01-32",
        "A02.SET02",
        "A02.SET17",
        "A02.SET17.MP01-32",
        "LR01.CP01",
        "CR01.TP01-03",
        "CR01.TP01.MP01-25",
    };
    return LocationMap::Create(ranges).value();
}

} // namespace

TEST_CASE("10 A map has each place of its ranges once")
{
    LocationMap map = MakeMap();
    CHECK(map.GetCount() == 6 + 6 + 4 + 12 + 32 + 32 + 1 + 1 + 32 + 1 + 3 + 25);
    CHECK(map.Contains(MakeKey("A01.CP01.TP04")));
    CHECK(map.Contains(MakeKey("a1.cp1.tp4")));
    CHECK_FALSE(map.Contains(MakeKey("A01.CP01.TP05")));
    CHECK_FALSE(map.Contains(MakeKey("A01")));
    CHECK_FALSE(map.Contains(MakeKey("SET01")));
    const std::size_t count = map.GetCount();
    map.Add(MakeKey("a01.cp1"));
    CHECK(map.GetCount() == count);
}

TEST_CASE("10 A line of a map that is not a range is named in the error")
{
    const std::vector<std::string> ranges{"A01.CP01-06", "A01.CP06-01"};
    const Result<LocationMap> map = LocationMap::Create(ranges);
    REQUIRE_FALSE(map.has_value());
    CHECK(map.error().code == ECoreError::InvalidLocation);
    CHECK(map.error().path == "[1]");
}

TEST_CASE("10 AMR and the robot's own name are ports of the robot that executes the plan, another name is refused")
{
    const LocationMap map = MakeMap();
    const RobotID robotID = RobotID::Parse("LR01").value();
    for (const std::string_view text : {"AMR.CP01", "LR01.CP01", "amr.cp1"})
    {
        INFO(text);
        const Result<Location> place = map.Resolve(MakeKey(text), robotID);
        REQUIRE(place.has_value());
        CHECK(*place == MakeKey("LR01.CP01"));
        CHECK(place->GetOriginalText() == text);
    }
    const Result<Location> other = map.Resolve(MakeKey("CR01.TP01"), robotID);
    REQUIRE_FALSE(other.has_value());
    CHECK(other.error().expected == "a port of LR01");
    CHECK_FALSE(map.Resolve(MakeKey("AMR.CP02"), robotID).has_value());
    CHECK_FALSE(map.Resolve(MakeKey("AMR.TP01"), robotID).has_value());
}

TEST_CASE("10 A set without area belongs to the position's area, else to the only one of the site, else it is refused")
{
    const LocationMap map = MakeMap();
    const RobotID robotID = RobotID::Parse("CR01").value();
    const Location inFirst = MakeKey("A01.CP03");
    const Location inSecond = MakeKey("A02.SET17");
    const Location outside = MakeKey("ST01.CP01");

    const Result<Location> first = map.Resolve(MakeKey("SET02.MP15"), robotID, &inFirst);
    REQUIRE(first.has_value());
    CHECK(first->GetText() == "A01.SET02.MP15");
    CHECK(first->GetOriginalText() == "SET02.MP15");
    CHECK(map.Resolve(MakeKey("SET02"), robotID, &inSecond).value().GetText() == "A02.SET02");
    CHECK(map.Resolve(MakeKey("SET17.MP01"), robotID).value().GetText() == "A02.SET17.MP01");
    CHECK(map.Resolve(MakeKey("set17.mp1"), robotID, &outside).value().GetText() == "A02.SET17.MP01");

    // Both areas have SET02; no area has SET13; the position's area has no SET17.
    CHECK_FALSE(map.Resolve(MakeKey("SET02"), robotID).has_value());
    CHECK_FALSE(map.Resolve(MakeKey("SET13"), robotID).has_value());
    CHECK_FALSE(map.Resolve(MakeKey("SET17"), robotID, &inFirst).has_value());
    CHECK_FALSE(map.CompleteSetOrNull(MakeKey("A01.SET01")).has_value());
}

TEST_CASE("10 A fixed place of the site is resolved to itself")
{
    const LocationMap map = MakeMap();
    const RobotID robotID = RobotID::Parse("CR01").value();
    CHECK(map.Resolve(MakeKey("a01.set1.mp32"), robotID).value() == MakeKey("A01.SET01.MP32"));
    const Result<Location> unknown = map.Resolve(MakeKey("A01.SET01.MP33"), robotID);
    REQUIRE_FALSE(unknown.has_value());
    CHECK(unknown.error().code == ECoreError::InvalidLocation);
    CHECK(unknown.error().expected == "a place of this site");
}

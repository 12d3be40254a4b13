#include "config/SitePlaces.hpp"

#include "Catch.hpp"
#include "config/ExampleSite.hpp"

#include <string>

namespace ACS::Acsd::Test
{

TEST_CASE("A number that no place of the action has at this site is an error, because it would be 0 in each job")
{
    const std::string tray = "actions.TrayLoad.arm_inputs";
    const std::string memory = "actions.MemoryPickAndPlace.arm_inputs";
    CheckErrors({
        {{tray + ".ml120='{from.st}'"}, tray + ".ml120: no place of this action has {from.st}"},
        {{"actions.TrayUnload.arm_inputs.ml120='{to.st}'"},
         "actions.TrayUnload.arm_inputs.ml120: no place of this action has {to.st}"},
        {{memory + ".ml120='{from.st}'"}, memory + ".ml120: no place of this action has {from.st}"},
        {{memory + ".ml120='{from.cp}'"}, memory + ".ml120: no place of this action has {from.cp}"},
        {{"actions.CassetteLoad.parameters.rack='{from.st}'", "site.map=nowhere"}, "site.map: "},
        {{R"(robots.CR01.actions.TrayLoad.arm_inputs={ml120="{from.st}"})"},
         "robots.CR01.actions.TrayLoad.arm_inputs.ml120: no place of this action has {from.st}"},
    });
    CHECK(
        ReadSite({"actions.CassetteLoad.parameters.rack='{from.st}'",
                  "actions.OpenSetCover.arm_inputs.ml120='{position.st}'",
                  memory + ".ml120='{from.tp}'"})
            .errors
        == std::vector<std::string>{});
}

TEST_CASE("A site without places of an action, or without its robots, has no jobs of it: its numbers are not checked")
{
    Planning::EngineOptions engine;
    const StationTable stations{{"A01.CP01", {}}, {"CHG01", {}}};
    const SitePlaces places(stations, engine);
    using Core::ESegmentKind;
    using Planning::EPlaceRule;
    using Planning::ERobotType;
    CHECK(places.HasSegment(EPlaceRule::FixedCassette, ERobotType::LR, ESegmentKind::Area));
    CHECK_FALSE(places.HasSegment(EPlaceRule::FixedCassette, ERobotType::LR, ESegmentKind::Stocker));
    CHECK(places.HasSegment(EPlaceRule::FixedTray, ERobotType::CR, ESegmentKind::Stocker));
    CHECK(places.HasSegment(EPlaceRule::RobotTray, ERobotType::CR, ESegmentKind::TrayPort));
    CHECK(places.HasSegment(EPlaceRule::Memory, ERobotType::CR, ESegmentKind::Set));

    engine.places = {*Core::Location::Parse("SET01.MP01")};
    const SitePlaces sets(stations, engine);
    CHECK(sets.HasSegment(EPlaceRule::Memory, ERobotType::CR, ESegmentKind::Set));
    CHECK(sets.HasSegment(EPlaceRule::Memory, ERobotType::CR, ESegmentKind::TrayPort)); // as robots have it
    CHECK_FALSE(sets.HasSegment(EPlaceRule::Memory, ERobotType::CR, ESegmentKind::Area));
    CHECK_FALSE(sets.HasSegment(EPlaceRule::Memory, ERobotType::CR, ESegmentKind::CassettePort));
    CHECK(sets.HasStationSegment(ESegmentKind::Area));
    CHECK_FALSE(sets.HasStationSegment(ESegmentKind::Stocker));
}

} // namespace ACS::Acsd::Test

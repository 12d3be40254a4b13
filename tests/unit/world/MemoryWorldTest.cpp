#include "world/MemoryWorld.hpp"

#include "Catch.hpp"
#include "world/EWorldError.hpp"

#include <fmt/format.h>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Sim::EMemory;
using Sim::EWorldError;
using Sim::MemoryWorld;

namespace
{

/// A cassette with a tray at A01.CP01, a tray at A01.CP02, and the robots LR01 and CR01 docked at both.
void FillFloor(MemoryWorld& world)
{
    REQUIRE(world.Act(Sim::CarrierPlaced{"CASSETTE_01", "A01.CP01"}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"TRAY_01", "A01.CP01.TP01"}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"TRAY_02", "A01.CP02.TP01"}));
    REQUIRE(world.Act(Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP05"}}));
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {"A01.CP01", "A01.CP02", "A01.SET01"}}));
    static_cast<void>(world.TakeEvents());
}

EWorldError GetError(const Core::Result<void>& result)
{
    REQUIRE_FALSE(result.has_value());
    INFO(Core::Describe(result.error()));
    REQUIRE(std::string_view(result.error().code.category().name()) == "acs.world");
    return static_cast<EWorldError>(result.error().code.value());
}

} // namespace

TEST_CASE("A cassette is moved with its trays and their memories")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::MemoryPlaced{"A01.CP01.TP01.MP07", EMemory::Occupied}));
    REQUIRE(world.Act(Sim::CarrierMoved{"LR01", "CASSETTE_01", "A01.CP01", "LR01.CP01"}));
    CHECK(world.GetPlaceOrNull("CASSETTE_01") == "LR01.CP01");
    CHECK(world.GetPlaceOrNull("TRAY_01") == "LR01.CP01.TP01");
    CHECK(world.GetPlaceOrNull("TRAY_02") == "A01.CP02.TP01");
    CHECK(world.GetMemory("LR01.CP01.TP01.MP07") == EMemory::Occupied);
    CHECK_FALSE(world.GetCarrierOrNull("A01.CP01").has_value());
    CHECK_FALSE(world.GetCarrierOrNull("A01.CP01.TP01").has_value());

    REQUIRE(world.Act(Sim::CarrierMoved{"LR01", "", "LR01.CP01", "A01.CP05"}));
    CHECK(world.GetCarrierOrNull("A01.CP05.TP01") == "TRAY_01");
    CHECK(world.GetMemory("A01.CP05.TP01.MP07") == EMemory::Occupied);
}

TEST_CASE("A place whose name begins with that of another place is not inside it")
{
    MemoryWorld world;
    REQUIRE(world.Act(Sim::CarrierPlaced{"ONE", "A01.CP10"}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"TWO", "A01.CP100"}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"TRAY", "A01.CP10.TP01"}));
    REQUIRE(world.Act(Sim::RobotDocked{"LR01", {"A01.CP10"}}));
    REQUIRE(world.Act(Sim::CarrierMoved{"LR01", "ONE", "A01.CP10", "LR01.CP01"}));
    CHECK(world.GetPlaceOrNull("TWO") == "A01.CP100");
    CHECK(world.GetPlaceOrNull("TRAY") == "LR01.CP01.TP01");
}

TEST_CASE("A carrier is picked only at its place and dropped only at a free place")
{
    MemoryWorld world;
    FillFloor(world);
    const auto move = [&world](const char* carrier, const char* from, const char* to) {
        return world.Act(Sim::CarrierMoved{"CR01", carrier, from, to});
    };
    CHECK(GetError(move("", "A01.CP02.TP02", "CR01.TP01")) == EWorldError::PlaceEmpty);
    CHECK(GetError(move("TRAY_01", "A01.CP02.TP01", "CR01.TP01")) == EWorldError::OtherCarrier);
    CHECK(GetError(move("TRAY_01", "A01.CP01.TP01", "A01.CP02.TP01")) == EWorldError::PlaceOccupied);
    CHECK(GetError(move("TRAY_01", "A01.CP01.TP01", "A01.CP01.TP01")) == EWorldError::PlaceOccupied);
    CHECK(GetError(move("TRAY_01", "A01.CP01.TP01", "CR01.CP01")) == EWorldError::InvalidPlace);
    CHECK(GetError(move("TRAY_01", "A01.CP01.TP01", "A01.SET01.MP01")) == EWorldError::InvalidPlace);
    CHECK(GetError(move("TRAY_01", "A01.CP01.TP01", "AMR.TP01")) == EWorldError::InvalidPlace);
    CHECK(world.TakeEvents().empty());
    CHECK(world.GetPlaceOrNull("TRAY_01") == "A01.CP01.TP01");

    REQUIRE(move("TRAY_01", "A01.CP01.TP01", "CR01.TP02"));
    CHECK(world.GetCarrierOrNull("cr01.tp2") == std::nullopt); // names keep their case
    CHECK(world.GetCarrierOrNull("CR01.TP2") == "TRAY_01");
}

TEST_CASE("A cassette cannot be put on trays that are at the place without a cassette")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP02"}}));
    CHECK(
        GetError(world.Act(Sim::CarrierMoved{"LR01", "CASSETTE_01", "A01.CP01", "A01.CP02"}))
        == EWorldError::PlaceOccupied);
}

TEST_CASE("A robot reaches only its own ports and the stations at which it is docked")
{
    MemoryWorld world;
    FillFloor(world);
    const Sim::CarrierMoved far{"CR01", "TRAY_01", "A01.CP01.TP01", "A01.CP05.TP01"};
    CHECK(GetError(world.Act(far)) == EWorldError::OutOfReach);
    const Sim::CarrierMoved foreign{"CR01", "TRAY_01", "A01.CP01.TP01", "CR02.TP01"};
    CHECK(GetError(world.Act(foreign)) == EWorldError::OutOfReach);
    const Sim::CarrierMoved own{"CR01", "TRAY_01", "A01.CP01.TP01", "CR01.TP01"};
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {}}));
    CHECK(GetError(world.Act(own)) == EWorldError::OutOfReach);
    CHECK(GetError(world.Act(Sim::CoverMoved{"CR01", "A01.SET01", true})) == EWorldError::OutOfReach);
    CHECK(GetError(world.Act(Sim::ButtonPushed{"CR01", "A01.SET01"})) == EWorldError::OutOfReach);
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {"a01.cp1"}}));
    CHECK(world.Act(own).has_value());
}

TEST_CASE("A robot that stays docked causes no event")
{
    MemoryWorld world;
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {}}));
    CHECK(world.TakeEvents().empty());
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {"A01.CP01", "A01.CP02"}}));
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {"A01.CP02", "A01.CP01"}}));
    CHECK(world.TakeEvents().size() == 1);
    REQUIRE(world.Act(Sim::RobotDocked{"CR01", {}}));
    CHECK(world.TakeEvents().size() == 1);
}

TEST_CASE("An unknown memory place is accepted as empty and as occupied and becomes known")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::CarrierMoved{"CR01", "TRAY_02", "A01.CP02.TP01", "CR01.TP01"}));
    const Sim::MemoryMoved load{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"};
    CHECK(world.GetMemory("A01.SET01.MP01") == EMemory::Unknown);
    REQUIRE(world.Act(load));
    CHECK(world.GetMemory("CR01.TP01.MP01") == EMemory::Empty);
    CHECK(world.GetMemory("A01.SET01.MP01") == EMemory::Occupied);
    CHECK(GetError(world.Act(load)) == EWorldError::PlaceEmpty);
    CHECK(
        GetError(world.Act(Sim::MemoryMoved{"CR01", "CR01.TP01.MP02", "A01.SET01.MP01"}))
        == EWorldError::PlaceOccupied);
    CHECK(
        GetError(world.Act(Sim::MemoryMoved{"CR01", "CR01.TP01.MP02", "CR01.TP01.MP02"}))
        == EWorldError::PlaceOccupied);
    REQUIRE(world.Act(Sim::MemoryMoved{"CR01", "A01.SET01.MP01", "CR01.TP01.MP01"}));
    CHECK(world.GetMemory("A01.SET01.MP01") == EMemory::Empty);
}

TEST_CASE("An absent tray has no memory places")
{
    MemoryWorld world;
    FillFloor(world);
    CHECK(GetError(world.Act(Sim::MemoryMoved{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"})) == EWorldError::PlaceEmpty);
    CHECK(GetError(world.Act(Sim::MemoryPlaced{"CR01.TP01.MP01", EMemory::Empty})) == EWorldError::PlaceEmpty);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{"TRAY_09", "LR01.CP01.TP01"})) == EWorldError::PlaceEmpty);
}

TEST_CASE("A set with a closed cover cannot be worked on")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::CarrierMoved{"CR01", "TRAY_02", "A01.CP02.TP01", "CR01.TP01"}));
    CHECK_FALSE(world.IsCovered("A01.SET01"));
    REQUIRE(world.Act(Sim::CoverMoved{"CR01", "a01.set1", true}));
    CHECK(world.IsCovered("A01.SET01"));
    const Sim::MemoryMoved in{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"};
    const Sim::MemoryMoved out{"CR01", "A01.SET01.MP02", "CR01.TP01.MP02"};
    CHECK(GetError(world.Act(in)) == EWorldError::CoverClosed);
    CHECK(GetError(world.Act(out)) == EWorldError::CoverClosed);
    CHECK(world.Act(Sim::ButtonPushed{"CR01", "A01.SET01"}).has_value());
    REQUIRE(world.Act(Sim::CoverMoved{"CR01", "A01.SET01", false}));
    CHECK(world.Act(in).has_value());
    CHECK(GetError(world.Act(Sim::CoverMoved{"CR01", "A01.CP01", true})) == EWorldError::InvalidPlace);
}

TEST_CASE("A carrier that is placed by hand replaces the one at the place")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::CarrierPlaced{"CASSETTE_02", "A01.CP01"}));
    CHECK(world.GetCarrierOrNull("A01.CP01") == "CASSETTE_02");
    CHECK_FALSE(world.GetPlaceOrNull("CASSETTE_01").has_value());
    CHECK_FALSE(world.GetPlaceOrNull("TRAY_01").has_value());

    REQUIRE(world.Act(Sim::CarrierPlaced{"TRAY_01", "A01.CP01.TP01"}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"CASSETTE_02", "A01.CP01"})); // it is there already, with its tray
    CHECK(world.GetPlaceOrNull("TRAY_01") == "A01.CP01.TP01");

    REQUIRE(world.Act(Sim::CarrierPlaced{"CASSETTE_02", "A01.CP02"})); // TRAY_02 is gone
    CHECK(world.GetPlaceOrNull("TRAY_01") == "A01.CP02.TP01");
    CHECK_FALSE(world.GetPlaceOrNull("TRAY_02").has_value());

    CHECK(GetError(world.Act(Sim::CarrierPlaced{"TRAY_01", "A01.CP07"})) == EWorldError::InvalidPlace);
    REQUIRE(world.Act(Sim::CarrierPlaced{"", "A01.CP02.TP01"}));
    CHECK_FALSE(world.GetPlaceOrNull("TRAY_01").has_value());
    REQUIRE(world.Act(Sim::CarrierPlaced{"CASSETTE_02", ""}));
    CHECK_FALSE(world.GetCarrierOrNull("A01.CP02").has_value());
    CHECK(world.Act(Sim::CarrierPlaced{"NOWHERE", ""}).has_value());
}

TEST_CASE("A new tray does not have the memories of the one before")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::MemoryPlaced{"A01.CP02.TP01.MP01", EMemory::Occupied}));
    REQUIRE(world.Act(Sim::CarrierPlaced{"TRAY_03", "A01.CP02.TP01"}));
    CHECK(world.GetMemory("A01.CP02.TP01.MP01") == EMemory::Unknown);
}

TEST_CASE("Events are kept in canonical spelling with the carrier's name, up to a limit")
{
    MemoryWorld world;
    FillFloor(world);
    REQUIRE(world.Act(Sim::CarrierMoved{"CR01", "", "a01.cp02.tp1", "CR01.TP1"}));
    const std::vector<Sim::WorldEvent> events = world.TakeEvents();
    REQUIRE(events.size() == 1);
    CHECK(std::get<Sim::CarrierMoved>(events[0]) == Sim::CarrierMoved{"CR01", "TRAY_02", "A01.CP02.TP01", "CR01.TP01"});
    CHECK(world.TakeEvents().empty());

    std::size_t done = 0;
    while (done <= MemoryWorld::MAX_EVENTS
           && world.Act(Sim::ButtonPushed{"CR01", done == 0 ? "A01.CP01" : "A01.SET01"}).has_value())
    {
        ++done;
    }
    REQUIRE(done == MemoryWorld::MAX_EVENTS + 1);
    const std::vector<Sim::WorldEvent> last = world.TakeEvents();
    REQUIRE(last.size() == MemoryWorld::MAX_EVENTS);
    CHECK(std::get<Sim::ButtonPushed>(last[0]).place == "A01.SET01");
}

TEST_CASE("Names are checked")
{
    MemoryWorld world;
    CHECK(GetError(world.Act(Sim::RobotDocked{"AMR", {}})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::RobotDocked{"A01", {}})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::RobotDocked{"CR01", {""}})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{"", ""})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{"two\nlines", "A01.CP01"})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{"\xff", "A01.CP01"})) == EWorldError::InvalidName);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{std::string(257, 'x'), "A01.CP01"})) == EWorldError::InvalidName);
    CHECK(world.Act(Sim::CarrierPlaced{std::string(256, 'x'), "A01.CP01"}).has_value());
    const std::vector<std::string> stations(MemoryWorld::MAX_STATIONS + 1, "A01.CP01");
    CHECK(GetError(world.Act(Sim::RobotDocked{"CR01", stations})) == EWorldError::LimitExceeded);
}

TEST_CASE("A robot docks at fixed places and chargers, not at a port of a robot or inside a station")
{
    MemoryWorld world;
    CHECK(world.Act(Sim::RobotDocked{"CR01", {"A01.CP01", "a01.set1", "CHG01", "gate 7"}}).has_value());
    CHECK(world.TakeEvents().size() == 1);
    for (const char* station : {"LR01.CP01", "LR01.CP01.TP01", "AMR.CP01", "SET01", "A01.CP01.TP01", "A01.SET01.MP01"})
    {
        INFO(station);
        CHECK(GetError(world.Act(Sim::RobotDocked{"CR01", {"CHG01", station}})) == EWorldError::InvalidPlace);
    }
    CHECK(world.TakeEvents().empty());
}

TEST_CASE("The number of carriers is limited")
{
    MemoryWorld world;
    std::size_t done = 0;
    while (
        done < MemoryWorld::MAX_CARRIERS
        && world.Act(
            Sim::CarrierPlaced{fmt::format("C{}", done), fmt::format("A{}.CP{}", done / 9'000 + 1, done % 9'000 + 1)}))
    {
        ++done;
    }
    REQUIRE(done == MemoryWorld::MAX_CARRIERS);
    CHECK(GetError(world.Act(Sim::CarrierPlaced{"one more", "A99.CP01"})) == EWorldError::LimitExceeded);
    CHECK(world.Act(Sim::CarrierPlaced{"C0", "A99.CP01"}).has_value());
}

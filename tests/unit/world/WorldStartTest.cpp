#include "Catch.hpp"
#include "world/MemoryWorld.hpp"

#include <memory>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Sim::EMemory;

namespace
{

Core::Result<std::unique_ptr<Sim::MemoryWorld>> Load(std::string_view text)
{
    const Core::Result<Sim::WorldStart> start = Sim::DecodeWorldStart(text);
    if (!start.has_value())
    {
        return tl::make_unexpected(start.error());
    }
    return Sim::MemoryWorld::Create(*start);
}

} // namespace

TEST_CASE("A world file has the places of carriers, the closed covers and the memories")
{
    const auto world = Load(R"({"version":1,
        "carriers":{"CASSETTE_01":"a01.cp1","TRAY_01":"A01.CP01.TP01","TRAY_02":"LR01.CP01.TP03","BOX":"LR01.CP01"},
        "covers":{"A01.SET01":"closed","A01.SET02":"open"},
        "memories":{"A01.SET01.MP01":"occupied","A01.SET01.MP02":"empty","A01.CP01.TP01.MP01":"unknown"}})");
    REQUIRE(world.has_value());
    CHECK((*world)->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
    CHECK((*world)->GetCarrierOrNull("LR01.CP01.TP03") == "TRAY_02");
    CHECK((*world)->IsCovered("A01.SET01"));
    CHECK_FALSE((*world)->IsCovered("A01.SET02"));
    CHECK((*world)->GetMemory("A01.SET01.MP01") == EMemory::Occupied);
    CHECK((*world)->GetMemory("A01.SET01.MP02") == EMemory::Empty);
    CHECK((*world)->GetMemory("A01.SET01.MP03") == EMemory::Unknown);
    CHECK((*world)->TakeEvents().empty());
}

TEST_CASE("An empty floor is valid")
{
    CHECK(Load(R"({"version":1})").has_value());
}

TEST_CASE("A floor with listed places has no others")
{
    const auto world = Load(R"({"version":1,"places":["A01.CP01.TP01-04","A01.SET01.MP01-02","CR01.TP01-02","A01.CP02"],
        "carriers":{"TRAY_01":"A01.CP01.TP04","CASSETTE_01":"LR07.CP09"}})");
    REQUIRE(world.has_value());
    const auto place = [&world](const char* carrier, const char* where) {
        return (*world)->Act(Sim::CarrierPlaced{carrier, where}).has_value();
    };
    CHECK(place("TRAY_02", "CR01.TP02"));
    CHECK_FALSE(place("TRAY_03", "CR01.TP03"));
    CHECK(place("TRAY_03", "CR02.TP03"));
    CHECK_FALSE(place("TRAY_03", "A01.CP01.TP05"));
    CHECK_FALSE(place("TRAY_03", "A01.CP02.TP01"));
    CHECK(place("CASSETTE_02", "A01.CP02"));
    CHECK(place("TRAY_04", "LR07.CP09.TP01"));
    CHECK((*world)->Act(Sim::MemoryPlaced{"CR01.TP02.MP05", EMemory::Empty}).has_value());
    CHECK((*world)->Act(Sim::MemoryPlaced{"A01.CP01.TP04.MP05", EMemory::Empty}).has_value());
    CHECK_FALSE((*world)->Act(Sim::MemoryPlaced{"A01.SET01.MP03", EMemory::Empty}).has_value());
    REQUIRE((*world)->Act(Sim::RobotDocked{"CR01", {"A01.SET01", "A01.SET02"}}).has_value());
    CHECK((*world)->Act(Sim::CoverMoved{"CR01", "A01.SET01", true}).has_value());
    CHECK_FALSE((*world)->Act(Sim::CoverMoved{"CR01", "A01.SET02", true}).has_value());
}

TEST_CASE("An error has its path in the file")
{
    struct InvalidFile
    {
        const char* text;
        const char* path;
    };
    for (const InvalidFile& file : {
             InvalidFile{"", ""},
             InvalidFile{"[]", ""},
             InvalidFile{"{}", "version"},
             InvalidFile{R"({"version":2})", "version"},
             InvalidFile{R"({"version":"1"})", "version"},
             InvalidFile{R"({"version":1,"carriers":{},"carriers":{}})", "carriers"},
             InvalidFile{R"({"version":1,"carriers":{"TRAY_01":"A01.CP01","TRAY_01":"A01.CP02"}})", "carriers.TRAY_01"},
             InvalidFile{R"({"version":1,"cariers":{}})", "\"cariers\""},
             InvalidFile{R"({"version":1,"carriers":[]})", "carriers"},
             InvalidFile{R"({"version":1,"carriers":{"TRAY_01":7}})", "carriers.TRAY_01"},
             InvalidFile{R"({"version":1,"carriers":{"TRAY_01":"A01"}})", "carriers.TRAY_01"},
             InvalidFile{R"({"version":1,"carriers":{"TRAY_01":"AMR.TP01"}})", "carriers.TRAY_01"},
             InvalidFile{R"({"version":1,"carriers":{"TRAY_01":""}})", "carriers.TRAY_01"},
             InvalidFile{R"({"version":1,"carriers":{"":"A01.CP01"}})", "carriers."},
             InvalidFile{R"({"version":1,"carriers":{"A":"A01.CP01","B":"A01.cp1"}})", "carriers.B"},
             InvalidFile{R"({"version":1,"carriers":{"A":"LR01.CP01.TP01"}})", "carriers.A"},
             InvalidFile{R"({"version":1,"covers":{"A01.SET01":"shut"}})", "covers.A01.SET01"},
             InvalidFile{R"({"version":1,"covers":{"A01.CP01":"closed"}})", "covers.A01.CP01"},
             InvalidFile{R"({"version":1,"memories":{"A01.SET01.MP01":"full"}})", "memories.A01.SET01.MP01"},
             InvalidFile{R"({"version":1,"memories":{"A01.SET01":"empty"}})", "memories.A01.SET01"},
             InvalidFile{R"({"version":1,"memories":{"CR01.TP01.MP01":"empty"}})", "memories.CR01.TP01.MP01"},
             InvalidFile{R"({"version":1,"places":"A01.CP01"})", "places"},
             InvalidFile{R"({"version":1,"places":["A01.CP01",3]})", "places[1]"},
             InvalidFile{R"({"version":1,"places":["A01.CP01.TP04-01"]})", "places \"A01.CP01.TP04-01\""},
             InvalidFile{R"({"version":1,"places":["A01.CP01"],"carriers":{"A":"A01.CP02"}})", "carriers.A"},
         })
    {
        INFO(file.text);
        const auto world = Load(file.text);
        REQUIRE_FALSE(world.has_value());
        CHECK(world.error().path == file.path);
        CHECK_FALSE(Core::Describe(world.error()).empty());
    }
}

TEST_CASE("A syntax error has its line and column")
{
    const auto world = Load("{\n  \"version\": 1,\n  \"carriers\": {\"A\": \"A01.CP01\" \"B\"}\n}\n");
    REQUIRE_FALSE(world.has_value());
    CHECK_THAT(Core::Describe(world.error()), Catch::Contains("line 3, column 32: Missing a comma"));
}

TEST_CASE("Deep nesting is refused")
{
    CHECK_FALSE(Load(R"({"version":1,"carriers":)" + std::string(100'000, '[')).has_value());
}

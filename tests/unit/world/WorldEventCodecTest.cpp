#include "world/WorldEventCodec.hpp"

#include "Catch.hpp"

#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)

TEST_CASE("Each event is encoded as a line and decoded as the same event")
{
    const std::vector<std::pair<Sim::WorldEvent, const char*>> lines{
        {Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP02"}},
         R"({"event":"RobotDocked","robot":"LR01","stations":["A01.CP01","A01.CP02"]})"},
        {Sim::CarrierMoved{"LR01", "CASSETTE_01", "A01.CP01", "LR01.CP01"},
         R"({"event":"CarrierMoved","robot":"LR01","carrier":"CASSETTE_01","from":"A01.CP01","to":"LR01.CP01"})"},
        {Sim::MemoryMoved{"CR01", "CR01.TP01.MP01", "A01.SET01.MP01"},
         R"({"event":"MemoryMoved","robot":"CR01","from":"CR01.TP01.MP01","to":"A01.SET01.MP01"})"},
        {Sim::CoverMoved{"CR01", "A01.SET01", true},
         R"({"event":"CoverMoved","robot":"CR01","set":"A01.SET01","closed":true})"},
        {Sim::ButtonPushed{"CR01", "A01.SET01"}, R"({"event":"ButtonPushed","robot":"CR01","place":"A01.SET01"})"},
        {Sim::CarrierPlaced{"TRAY \"1\"", ""}, R"({"event":"CarrierPlaced","carrier":"TRAY \"1\"","place":""})"},
        {Sim::MemoryPlaced{"A01.SET01.MP01", Sim::EMemory::Occupied},
         R"({"event":"MemoryPlaced","place":"A01.SET01.MP01","memory":"occupied"})"}};
    for (const auto& [event, line] : lines)
    {
        CHECK(Sim::EncodeWorldEvent(event) == line);
        const Core::Result<Sim::WorldEvent> read = Sim::DecodeWorldEvent(line);
        REQUIRE(read.has_value());
        CHECK((*read == event));
    }
}

TEST_CASE("A line that is not an event is refused")
{
    for (const char* line :
         {"",
          "{",
          "null",
          "[]",
          "{}",
          R"({"event":7})",
          R"({"event":"Explosion"})",
          R"({"event":"carriermoved"})",
          R"({"event":"ButtonPushed","robot":"CR01"})",
          R"({"event":"ButtonPushed","robot":"CR01","place":7})",
          R"({"event":"ButtonPushed","robot":"CR01","place":"A01.SET01","more":1})",
          R"({"event":"ButtonPushed","event":"CoverMoved","robot":"CR01","place":"A01.SET01"})",
          R"({"event":"MemoryPlaced","place":"A01.SET01.MP01","memory":"full"})",
          R"({"event":"CoverMoved","robot":"CR01","set":"A01.SET01"})"})
    {
        INFO(line);
        CHECK_FALSE(Sim::DecodeWorldEvent(line).has_value());
    }
}

#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"
#include "controller/FaultFixture.hpp"
#include "programs/ProgramFile.hpp"
#include "TemporaryFolder.hpp"
#include "world/MemoryWorld.hpp"
#include "world/WorldFile.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using ACS::OpenStreamSim::ControllerOptions;
using ACS::OpenStreamSim::ProgramFile;
using ACS::Testing::ControllerFixture;
using ACS::Testing::FaultFixture;
using namespace ACS::Sim; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

/// The arm of CR01 with these programs, ready, on the floor.
ControllerOptions MakeArmOptions(IWorld& world, const ProgramFile& file)
{
    REQUIRE(file.mistakes.empty());
    ControllerOptions options = ControllerFixture::MakeReadyOptions();
    options.programs = file.programs;
    options.robotID = "CR01";
    options.world = &world;
    return options;
}

/// An arm of CR01 with the programs of the example site, docked at A01.CP01 and A01.SET01 of a floor in memory.
class FloorFixture
{
public:
    MemoryWorld world;
    ControllerFixture harness;

    FloorFixture()
        : harness(MakeArmOptions(world, ProgramFile::Read(ACS_SITE "/programs.toml")))
    {
        Do(RobotDocked{"CR01", {"A01.CP01", "A01.SET01"}});
        Do(CarrierPlaced{"TRAY_01", "A01.CP01.TP01"});
    }

    void Do(const WorldEvent& event)
    {
        REQUIRE(world.Act(event).has_value());
        static_cast<void>(world.TakeEvents());
    }

    void Write(const std::vector<std::pair<int, int>>& words)
    {
        for (const auto& [word, number] : words)
        {
            const std::string body =
                R"({"name":"ml)" + std::to_string(word) + R"(","value":)" + std::to_string(number) + "}";
            REQUIRE(harness.Post("/project/plc/set_relay_value", body) == 200);
        }
    }

    void Start(int program)
    {
        REQUIRE(harness.Select(program) == 200);
        REQUIRE(harness.Start() == 200);
    }

    /// The counters after the program with these words, and with the echo.
    std::string Run(int program, const std::vector<std::pair<int, int>>& words)
    {
        Write(words);
        Start(program);
        harness.clock.Advance(2s);
        return harness.Get("/project/plc/m/val_s32?st=400&len=5");
    }
};

} // namespace

TEST_CASE("A tray is moved at the good end of the program, from and to the places that its words name")
{
    FloorFixture fixture;
    fixture.Write({{105, 4711}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    REQUIRE(fixture.harness.Get("/project/plc/m/val_s32?st=400&len=5") == "[1,0,0,0,4711]");
    fixture.harness.clock.Advance(1'999ms);
    REQUIRE(fixture.harness.GetCounters() == "[1,0,0,0]");
    REQUIRE(fixture.world.TakeEvents().empty());
    fixture.harness.clock.Advance(1ms);
    REQUIRE(fixture.harness.GetCounters() == "[1,1,0,11]");
    REQUIRE(
        fixture.world.TakeEvents()
        == std::vector<WorldEvent>{CarrierMoved{"CR01", "TRAY_01", "A01.CP01.TP01", "CR01.TP02"}});
    REQUIRE(fixture.Run(13, {{105, 4712}, {108, 3}}) == "[2,2,0,13,4712]");
    REQUIRE(fixture.world.GetPlaceOrNull("TRAY_01") == "A01.CP01.TP03");
}

TEST_CASE("The words count as they are where the program starts, not where it ends or goes on")
{
    FloorFixture fixture;
    fixture.Write({{105, 1}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    fixture.harness.clock.Advance(1s);
    REQUIRE(fixture.harness.Post("/project/robot/stop") == 200);
    fixture.Write({{105, 2}, {108, 4}, {109, 3}});
    REQUIRE(fixture.harness.Start() == 200);
    fixture.harness.clock.Advance(1s);
    REQUIRE(fixture.harness.Get("/project/plc/m/val_s32?st=400&len=5") == "[1,1,0,11,1]");
    REQUIRE(fixture.world.GetPlaceOrNull("TRAY_01") == "CR01.TP02");
}

TEST_CASE("A program fails where its places do not allow its work, and nothing moves")
{
    FloorFixture fixture;
    SECTION("the place to take from is empty")
    {
        REQUIRE(fixture.Run(11, {{105, 7}, {106, 1}, {107, 1}, {108, 2}, {109, 1}}) == "[1,0,1,11,7]");
    }
    SECTION("the place to put to is occupied")
    {
        fixture.Do(CarrierPlaced{"TRAY_02", "CR01.TP01"});
        REQUIRE(fixture.Run(11, {{105, 7}, {106, 1}, {107, 1}, {108, 1}, {109, 1}}) == "[1,0,1,11,7]");
    }
    SECTION("the station is out of reach")
    {
        fixture.Do(RobotDocked{"CR01", {}});
        REQUIRE(fixture.Run(11, {{105, 7}, {106, 1}, {107, 1}, {108, 1}, {109, 1}}) == "[1,0,1,11,7]");
    }
    SECTION("a word is 0")
    {
        REQUIRE(fixture.Run(11, {{105, 7}, {106, 1}, {107, 1}, {108, 1}, {109, 0}}) == "[1,0,1,11,7]");
    }
    SECTION("no word was written")
    {
        REQUIRE(fixture.Run(11, {}) == "[1,0,1,11,0]");
    }
    REQUIRE(fixture.world.TakeEvents().empty());
    REQUIRE(fixture.world.GetPlaceOrNull("TRAY_01") == "A01.CP01.TP01");
}

TEST_CASE("A program that is given up, or that a fault lets fail, moves nothing")
{
    FloorFixture fixture;
    fixture.Write({{105, 1}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    fixture.harness.clock.Advance(1s);
    REQUIRE(fixture.harness.Reset() == 200);
    REQUIRE(fixture.harness.GetCounters() == "[1,0,1,11]");
    fixture.harness.controller.GetMachine(fixture.harness.clock.GetNow()).SetProgramJudge([](int, bool bAtStart) {
        return !bAtStart;
    });
    fixture.Start(11);
    fixture.harness.clock.Advance(2s);
    REQUIRE(fixture.harness.GetCounters() == "[2,0,2,11]");
    REQUIRE(fixture.world.TakeEvents().empty());
}

TEST_CASE("Memories are moved both ways, as the first template without a zero says")
{
    FloorFixture fixture;
    fixture.Do(CarrierPlaced{"TRAY_02", "CR01.TP01"});
    fixture.Do(MemoryPlaced{"CR01.TP01.MP03", EMemory::Occupied});
    REQUIRE(
        fixture.Run(12, {{105, 1}, {106, 0}, {107, 0}, {108, 1}, {109, 3}, {112, 1}, {113, 1}, {114, 0}, {115, 32}})
        == "[1,1,0,12,1]");
    REQUIRE(
        fixture.world.TakeEvents() == std::vector<WorldEvent>{MemoryMoved{"CR01", "CR01.TP01.MP03", "A01.SET01.MP32"}});
    REQUIRE(
        fixture.Run(12, {{105, 2}, {106, 1}, {107, 1}, {108, 0}, {109, 32}, {112, 0}, {113, 0}, {114, 1}, {115, 4}})
        == "[2,2,0,12,2]");
    REQUIRE(fixture.world.GetMemory("CR01.TP01.MP04") == EMemory::Occupied);
    REQUIRE(fixture.world.GetMemory("A01.SET01.MP32") == EMemory::Empty);
}

TEST_CASE("Covers are closed and opened, and a closed one keeps the arm out of its set")
{
    FloorFixture fixture;
    REQUIRE(fixture.Run(15, {{105, 1}, {106, 1}, {107, 1}}) == "[1,1,0,15,1]");
    REQUIRE(fixture.world.IsCovered("A01.SET01"));
    fixture.Do(CarrierPlaced{"TRAY_02", "CR01.TP01"});
    REQUIRE(fixture.Run(12, {{105, 2}, {109, 1}, {112, 0}, {113, 0}, {114, 1}, {115, 1}}) == "[2,1,1,12,2]");
    REQUIRE(fixture.Run(14, {{105, 3}}) == "[3,2,1,14,3]");
    REQUIRE_FALSE(fixture.world.IsCovered("A01.SET01"));
    static_cast<void>(fixture.world.TakeEvents());
    REQUIRE(fixture.Run(16, {{105, 4}}) == "[4,3,1,16,4]");
    REQUIRE(fixture.world.TakeEvents() == std::vector<WorldEvent>{ButtonPushed{"CR01", "A01.SET01"}});
}

TEST_CASE("Programs that are not in the file take their time and have no echo")
{
    FloorFixture fixture;
    REQUIRE(fixture.Run(99, {{105, 5}, {106, 1}, {107, 1}, {108, 1}, {109, 2}}) == "[1,1,0,99,0]");
    REQUIRE(fixture.world.TakeEvents().empty());
}

TEST_CASE("An echo is an unsigned word of 32 bits")
{
    FloorFixture fixture;
    fixture.Write({{106, 1}, {107, 1}, {108, 1}, {109, 1}});
    REQUIRE(fixture.harness.Post("/project/plc/set_relay_value", R"({"name":"ml105","value":2147483647})") == 200);
    fixture.Start(11);
    REQUIRE(fixture.harness.Get("/project/plc/m/val_s32?st=416&len=1") == "[2147483647]");
}

TEST_CASE("A program fails where the journal of the floor cannot be read, and the log has file and line")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1,"carriers":{"TRAY_01":"CR01.TP01"}})";
    const auto world = WorldFile::Open(file);
    REQUIRE(world.has_value());
    std::ofstream(file + ".journal", std::ios::app) << "no JSON\n";
    ControllerFixture harness(
        MakeArmOptions(**world, ProgramFile::ReadText("[11]\nfrom = [\"CR01.TP01\"]\nto = [\"CR01.TP02\"]", "p.toml")));
    REQUIRE(harness.Select(11) == 200);
    REQUIRE(harness.Start() == 200);
    harness.clock.Advance(2s);
    REQUIRE(harness.GetCounters() == "[1,0,1,11]");
    const auto& lines = harness.GetLog().GetLines();
    const auto reason = std::ranges::find(lines, "program cannot do its work", &ACS::Testing::RecordedLine::message);
    REQUIRE(reason != lines.end());
    REQUIRE_THAT(reason->fields.at(1).second, Catch::StartsWith(file + ".journal:1: "));
}

TEST_CASE("A program ends in its time though no client asks")
{
    MemoryWorld world;
    const WorldEvent move = CarrierMoved{"CR01", "TRAY_01", "CR01.TP01", "CR01.TP02"};
    REQUIRE(world.Act(CarrierPlaced{"TRAY_01", "CR01.TP01"}).has_value());
    static_cast<void>(world.TakeEvents());
    ControllerOptions options = MakeArmOptions(
        world,
        ProgramFile::ReadText("[11]\nduration = \"10s\"\nfrom = [\"CR01.TP01\"]\nto = [\"CR01.TP02\"]", "p.toml"));
    options.timeScale = 2.5;
    FaultFixture harness(options);
    REQUIRE_FALSE(harness.wakeAt.has_value());
    REQUIRE(harness.StartProgram(11) == 200);
    SECTION("it runs through")
    {
        harness.Pass(3'999ms);
        REQUIRE(world.TakeEvents().empty());
        harness.Pass(1ms);
        REQUIRE(world.TakeEvents() == std::vector{move});
        REQUIRE_FALSE(harness.wakeAt.has_value());
        REQUIRE(harness.GetCounters() == "[1,1,0,11]");
    }
    SECTION("it is stopped and goes on")
    {
        harness.Pass(1s);
        REQUIRE(harness.PostOverHTTP("/project/robot/stop") == 200);
        REQUIRE_FALSE(harness.wakeAt.has_value());
        harness.Pass(10s);
        REQUIRE(harness.PostOverHTTP("/project/robot/start") == 200);
        harness.Pass(2'999ms);
        REQUIRE(world.TakeEvents().empty());
        harness.Pass(1ms);
        REQUIRE(world.TakeEvents() == std::vector{move});
    }
    SECTION("a fault begins and ends meanwhile")
    {
        harness.Begin("silence at=1s for=1s");
        harness.Pass(4s);
        REQUIRE(world.TakeEvents() == std::vector{move});
        REQUIRE(harness.GetChanges().size() == 2);
    }
    SECTION("a fault halts it")
    {
        harness.Begin("estop at=1s");
        harness.Pass(1h);
        REQUIRE(world.TakeEvents().empty());
        REQUIRE_FALSE(harness.wakeAt.has_value());
    }
}

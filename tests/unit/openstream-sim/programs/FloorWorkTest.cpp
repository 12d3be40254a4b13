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
    REQUIRE(file.errors.empty());
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
    ControllerFixture arm;

    FloorFixture()
        : arm(MakeArmOptions(world, ProgramFile::Read(ACS_SITE "/programs.toml")))
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
            REQUIRE(arm.Post("/project/plc/set_relay_value", body) == 200);
        }
    }

    void Start(int program)
    {
        REQUIRE(arm.Select(program) == 200);
        REQUIRE(arm.Start() == 200);
    }

    /// The counters after the program with these words, and with the echo.
    std::string Run(int program, const std::vector<std::pair<int, int>>& words)
    {
        Write(words);
        Start(program);
        arm.clock.Advance(2s);
        return arm.Get("/project/plc/m/val_s32?st=400&len=5");
    }
};

} // namespace

TEST_CASE("A tray is moved when the program finishes, from and to the places in its relays")
{
    FloorFixture fixture;
    fixture.Write({{105, 4711}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    REQUIRE(fixture.arm.Get("/project/plc/m/val_s32?st=400&len=5") == "[1,0,0,0,4711]");
    fixture.arm.clock.Advance(1'999ms);
    REQUIRE(fixture.arm.GetCounters() == "[1,0,0,0]");
    REQUIRE(fixture.world.TakeEvents().empty());
    fixture.arm.clock.Advance(1ms);
    REQUIRE(fixture.arm.GetCounters() == "[1,1,0,11]");
    REQUIRE(
        fixture.world.TakeEvents()
        == std::vector<WorldEvent>{CarrierMoved{"CR01", "TRAY_01", "A01.CP01.TP01", "CR01.TP02"}});
    REQUIRE(fixture.Run(13, {{105, 4712}, {108, 3}}) == "[2,2,0,13,4712]");
    REQUIRE(fixture.world.GetPlaceOrNull("TRAY_01") == "A01.CP01.TP03");
}

TEST_CASE("The relays are read when the program begins, not when it ends or continues")
{
    FloorFixture fixture;
    fixture.Write({{105, 1}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    fixture.arm.clock.Advance(1s);
    REQUIRE(fixture.arm.Post("/project/robot/stop") == 200);
    fixture.Write({{105, 2}, {108, 4}, {109, 3}});
    REQUIRE(fixture.arm.Start() == 200);
    fixture.arm.clock.Advance(1s);
    REQUIRE(fixture.arm.Get("/project/plc/m/val_s32?st=400&len=5") == "[1,1,0,11,1]");
    REQUIRE(fixture.world.GetPlaceOrNull("TRAY_01") == "CR01.TP02");
}

TEST_CASE("A program fails if its places do not allow its work, and nothing moves")
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

TEST_CASE("A program that is abandoned, or that fails by a fault, moves nothing")
{
    FloorFixture fixture;
    fixture.Write({{105, 1}, {106, 1}, {107, 1}, {108, 1}, {109, 2}});
    fixture.Start(11);
    fixture.arm.clock.Advance(1s);
    REQUIRE(fixture.arm.Reset() == 200);
    REQUIRE(fixture.arm.GetCounters() == "[1,0,1,11]");
    fixture.arm.controller.GetMachine(fixture.arm.clock.GetNow()).SetProgramJudge([](int, bool bAtStart) {
        return !bAtStart;
    });
    fixture.Start(11);
    fixture.arm.clock.Advance(2s);
    REQUIRE(fixture.arm.GetCounters() == "[2,0,2,11]");
    REQUIRE(fixture.world.TakeEvents().empty());
}

TEST_CASE("Memories are moved both ways, by the first template without a zero")
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
    REQUIRE(fixture.arm.Post("/project/plc/set_relay_value", R"({"name":"ml105","value":2147483647})") == 200);
    fixture.Start(11);
    REQUIRE(fixture.arm.Get("/project/plc/m/val_s32?st=416&len=1") == "[2147483647]");
}

TEST_CASE("A program fails if the journal of the floor is unreadable, and the log has file and line")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1,"carriers":{"TRAY_01":"CR01.TP01"}})";
    const auto world = WorldFile::Open(file);
    REQUIRE(world.has_value());
    std::ofstream(file + ".journal", std::ios::app) << "no JSON\n";
    ControllerFixture arm(
        MakeArmOptions(**world, ProgramFile::ReadText("[11]\nfrom = [\"CR01.TP01\"]\nto = [\"CR01.TP02\"]", "p.toml")));
    REQUIRE(arm.Select(11) == 200);
    REQUIRE(arm.Start() == 200);
    arm.clock.Advance(2s);
    REQUIRE(arm.GetCounters() == "[1,0,1,11]");
    const auto& lines = arm.GetLog().GetLines();
    const auto reason = std::ranges::find(lines, "program could not do its work", &ACS::Testing::RecordedLine::message);
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
    FaultFixture arm(options);
    REQUIRE_FALSE(arm.wakeAt.has_value());
    REQUIRE(arm.StartProgram(11) == 200);
    SECTION("it runs through")
    {
        arm.Pass(3'999ms);
        REQUIRE(world.TakeEvents().empty());
        arm.Pass(1ms);
        REQUIRE(world.TakeEvents() == std::vector{move});
        REQUIRE_FALSE(arm.wakeAt.has_value());
        REQUIRE(arm.GetCounters() == "[1,1,0,11]");
    }
    SECTION("it is stopped and continued")
    {
        arm.Pass(1s);
        REQUIRE(arm.PostOverHTTP("/project/robot/stop") == 200);
        REQUIRE_FALSE(arm.wakeAt.has_value());
        arm.Pass(10s);
        REQUIRE(arm.PostOverHTTP("/project/robot/start") == 200);
        arm.Pass(2'999ms);
        REQUIRE(world.TakeEvents().empty());
        arm.Pass(1ms);
        REQUIRE(world.TakeEvents() == std::vector{move});
    }
    SECTION("a fault begins and ends meanwhile")
    {
        arm.Begin("silence at=1s for=1s");
        arm.Pass(4s);
        REQUIRE(world.TakeEvents() == std::vector{move});
        REQUIRE(arm.GetChanges().size() == 2);
    }
    SECTION("a fault halts it")
    {
        arm.Begin("estop at=1s");
        arm.Pass(1h);
        REQUIRE(world.TakeEvents().empty());
        REQUIRE_FALSE(arm.wakeAt.has_value());
    }
}

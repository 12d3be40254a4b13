#include "arm/MoveStatement.hpp"
#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <chrono>
#include <string>

using namespace std::chrono_literals;
using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using ACS::OpenStream::EApiMethod;
using ACS::Testing::ControllerFixture;

namespace
{

constexpr const char* MOVE_PATH = "/project/context/tasks[0]/execute_move";
constexpr const char* JOINTS = "/project/robot/joint_states?jno_start=1&jno_n=1";

int Command(ControllerFixture& fixture, const std::string& line)
{
    return fixture.Post("/console/execute_cmd", R"({"cmd_line":")" + line + R"("})");
}

bool IsKnown(ControllerFixture& fixture, const std::string& line)
{
    const auto answer = fixture.Call(EApiMethod::Post, "/console/execute_cmd", R"({"cmd_line":")" + line + R"("})");
    REQUIRE(answer.status == 200);
    return answer.body->GetText() == R"({"_type":"JObject"})";
}

std::string ExecuteMove(ControllerFixture& fixture, const std::string& statement)
{
    return fixture.PostForCode(MOVE_PATH, R"({"stmt":")" + statement + R"("})");
}

bool IsTrajectoryReady(ControllerFixture& fixture)
{
    return fixture.controller.GetMachine(fixture.clock.GetNow()).IsTrajectoryReady();
}

bool IsPlaying(ControllerFixture& fixture)
{
    return fixture.Contains("/project/rgen", R"("is_playback":1)");
}

bool IsAt(ControllerFixture& fixture, const std::string& angle)
{
    return fixture.Contains(JOINTS, "\"position\":[" + angle + "]");
}

} // namespace

TEST_CASE("A execute_move: the statement is read with blanks or commas, any interpolation, three units of speed")
{
    const MoveStatement sample{EMoveSpeed::Seconds, 1.0, {0, 90, 0, 0, 0, 0}};
    REQUIRE(ParseMoveOrNull("move SP,spd=1sec,accu=0,tool=1 [0 90 0 0 0 0]") == sample);
    REQUIRE(ParseMoveOrNull("  move P , spd = 1 sec , tool=31 , accu=7  [ 0, 90,0 ,0  , 0, 0.0 ] ") == sample);
    REQUIRE(ParseMoveOrNull("move L,spd=1sec [0,90,0,0,0,0]") == sample);
    const MoveStatement percent{EMoveSpeed::Percent, 12.5, {-10, 90, 0, 0, 0, 0}};
    REQUIRE(ParseMoveOrNull("move SL,spd=12.5%,accu=1 [-10,90,0,0,0,0]") == percent);
    const MoveStatement millimetres{EMoveSpeed::Millimetres, 500, {10, 90, 0, 0, 0, 0}};
    REQUIRE(ParseMoveOrNull("move C,spd=500mm/sec,accu=4,tool=0  [10, 90, 0, 0, 0, 0]") == millimetres);
}

TEST_CASE("A execute_move: an invalid statement is refused with -1376272, and nothing moves")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    for (const char* statement :
         {"",
          "move",
          "move [0,90,0,0,0,0]",
          "moveP,spd=1sec [0,90,0,0,0,0]",
          "stop",
          "move P [0,90,0,0,0,0]",
          "move X,spd=1sec [0,90,0,0,0,0]",
          "move ,spd=1sec [0,90,0,0,0,0]",
          "move P,spd=1 [0,90,0,0,0,0]",
          "move P,spd=1min [0,90,0,0,0,0]",
          "move P,spd=0sec [0,90,0,0,0,0]",
          "move P,spd=-1sec [0,90,0,0,0,0]",
          "move P,spd=nansec [0,90,0,0,0,0]",
          "move P,spd=infsec [0,90,0,0,0,0]",
          "move P,spd=1e300sec [0,90,0,0,0,0]",
          "move P,spd=101% [0,90,0,0,0,0]",
          "move P,spd=1e-300% [10,90,0,0,0,0]",
          "move P,spd=1e-300mm/sec [10,90,0,0,0,0]",
          "move P,spd=20000mm/sec [0,90,0,0,0,0]",
          "move P,spd=1sec,spd=1sec [0,90,0,0,0,0]",
          "move P,spd=1sec,accu=8 [0,90,0,0,0,0]",
          "move P,spd=1sec,accu=1.5 [0,90,0,0,0,0]",
          "move P,spd=1sec,tool=32 [0,90,0,0,0,0]",
          "move P,spd=1sec,tool=-1 [0,90,0,0,0,0]",
          "move P,spd=1sec,tool= [0,90,0,0,0,0]",
          "move P,spd=1sec,,tool=0 [0,90,0,0,0,0]",
          "move P,spd=1sec,smooth=1 [0,90,0,0,0,0]",
          "move P,spd=1sec []",
          "move P,spd=1sec [0,90,0,0,0]",
          "move P,spd=1sec [0,90,0,0,0,0,0]",
          "move P,spd=1sec [0,90,0,0,0,0] x",
          "move P,spd=1sec [0,90,0,0,0,0",
          "move P,spd=1sec [0,90,0,0,0,x]",
          "move P,spd=1sec [0,90,0,0,0,nan]",
          "move P,spd=1sec [0-90,0,0,0,0,0]",
          "move P,spd=1sec [180.1,90,0,0,0,0]",
          "move P,spd=1sec [1e308,90,0,0,0,0]"})
    {
        INFO(statement);
        CHECK_FALSE(ParseMoveOrNull(statement).has_value());
        CHECK(ExecuteMove(fixture, statement) == "403 -1376272");
    }
    REQUIRE(fixture.PostForCode(MOVE_PATH, "{}") == "400 -1");
    REQUIRE(ExecuteMove(fixture, std::string(1'001, 'm')) == "400 -1");
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "0"));
}

TEST_CASE(
    "A execute_move: the arm moves for the given time and is then stationary at the target; stop ends the move at once")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(ExecuteMove(fixture, "move P,spd=2sec,accu=0,tool=0 [40,90,0,0,0,0]") == "200");
    REQUIRE(IsAt(fixture, "0"));
    REQUIRE_FALSE(IsPlaying(fixture));
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "20"));
    REQUIRE(fixture.Contains(JOINTS, R"("velocity":[30])")); // half as fast again as the mean
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "40"));
    REQUIRE(fixture.Contains(JOINTS, R"("velocity":[0])"));
    REQUIRE(ExecuteMove(fixture, "move P,spd=2sec [0,90,0,0,0,0]") == "200");
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Post("/project/robot/stop") == 200);
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "20"));
    REQUIRE(ExecuteMove(fixture, "move P,spd=2sec [20,90,0,0,0,0]") == "200"); // no way to go
    fixture.clock.Advance(2s);
    REQUIRE(IsAt(fixture, "20"));
}

TEST_CASE("A execute_move: no axis exceeds its speed; % is relative to that speed, mm/sec applies to the flange")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(ExecuteMove(fixture, "move P,spd=0.001sec [100,90,0,0,0,0]") == "200");
    fixture.clock.Advance(375ms);
    REQUIRE(IsAt(fixture, "50"));
    REQUIRE(fixture.Contains(JOINTS, R"("velocity":[200])"));
    fixture.clock.Advance(375ms);
    REQUIRE(IsAt(fixture, "100"));
    REQUIRE(ExecuteMove(fixture, "move P,spd=50% [0,90,0,0,0,0]") == "200");
    fixture.clock.Advance(750ms);
    REQUIRE(IsAt(fixture, "50"));
    REQUIRE(fixture.Contains(JOINTS, R"("velocity":[-100])"));
    fixture.clock.Advance(750ms);
    // 60 deg at a reach of 1070 mm: 1070 mm straight
    REQUIRE(ExecuteMove(fixture, "move P,spd=535mm/sec [60,90,0,0,0,0]") == "200");
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Contains(JOINTS, R"("position":[30)"));
    fixture.clock.Advance(999ms);
    REQUIRE_FALSE(IsAt(fixture, "60"));
    fixture.clock.Advance(2ms);
    REQUIRE(IsAt(fixture, "60"));
}

TEST_CASE("A execute_move: a program that was stopped before its end is abandoned, and the next one starts from there")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Post("/project/robot/stop") == 200);
    REQUIRE(ExecuteMove(fixture, "move P,spd=1sec [40,90,0,0,0,0]") == "200");
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -1442080"); // moves
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "40"));
    REQUIRE(fixture.Start() == 200);
    REQUIRE(IsAt(fixture, "40"));
    fixture.clock.Advance(2s);
    REQUIRE(fixture.GetCounters() == "[2,1,1,11]");
}

TEST_CASE("A execute_cmd: moves and waits run one after the other, exactly in time, and end")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(fixture, "rl.i move P,spd=1sec,accu=4,tool=0 [10, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(fixture, "rl.i wait ml10") == 200);
    REQUIRE(Command(fixture, "rl.i move P,spd=1sec,accu=4,tool=0 [-10, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(fixture, "rl.i move P,spd=1sec,accu=4,tool=0 [0, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(fixture, "rl.i end") == 200);
    REQUIRE(Command(fixture, "rl.i move P,spd=1sec [99, 90, 0, 0, 0, 0]") == 200); // behind the end
    REQUIRE_FALSE(IsPlaying(fixture));
    REQUIRE(Command(fixture, "rl.start") == 200);
    REQUIRE(IsPlaying(fixture));
    fixture.clock.Advance(500ms);
    REQUIRE(IsAt(fixture, "5"));
    fixture.clock.Advance(9'500ms);
    REQUIRE(IsAt(fixture, "10"));
    REQUIRE(IsTrajectoryReady(fixture));
    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"ml10","value":7})") == 200);
    fixture.clock.Advance(1'500ms); // in one step
    REQUIRE(IsAt(fixture, "-5"));
    REQUIRE_FALSE(IsTrajectoryReady(fixture));
    fixture.clock.Advance(499ms);
    REQUIRE(IsPlaying(fixture));
    fixture.clock.Advance(1ms);
    REQUIRE_FALSE(IsPlaying(fixture));
    REQUIRE(IsAt(fixture, "0"));
    REQUIRE(fixture.GetCounters() == "[0,0,0,0]"); // it has none of its own
}

TEST_CASE("A execute_cmd: rl.stop halts a move, start resumes it, rl.reinit removes the statements")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(fixture, "rl.i move P,spd=2sec [40, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(fixture, "rl.start") == 200);
    fixture.clock.Advance(1s);
    REQUIRE(Command(fixture, "rl.stop") == 200);
    REQUIRE_FALSE(IsPlaying(fixture));
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "20"));
    REQUIRE(fixture.Start() == 200);
    fixture.clock.Advance(2s);
    REQUIRE(IsAt(fixture, "40"));
    REQUIRE(fixture.Start() == 200); // no program is selected: the console's, from its beginning
    REQUIRE(IsPlaying(fixture));
    REQUIRE(Command(fixture, "rl.reinit") == 200);
    REQUIRE_FALSE(IsPlaying(fixture));
    REQUIRE(fixture.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(fixture.PostForCode("/project/robot/start") == "403 -3");
}

TEST_CASE("A execute_cmd: a selected program replaces the console's, which replaces a halted one")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(fixture, "rl.i wait di1") == 200);
    REQUIRE(Command(fixture, "rl.start") == 200);
    REQUIRE(
        fixture.PostForCode("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"ext_sel":1})") == "403 -1442080");
    REQUIRE(Command(fixture, "rl.stop") == 200);
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
    fixture.clock.Advance(1s);
    REQUIRE(Command(fixture, "rl.stop") == 200);
    REQUIRE(Command(fixture, "rl.start") == 200);
    REQUIRE(fixture.GetCounters() == "[1,0,1,11]");
    REQUIRE(IsTrajectoryReady(fixture));
    REQUIRE(fixture.Reset() == 200);
    REQUIRE_FALSE(IsPlaying(fixture));
    REQUIRE(fixture.Start() == 200); // the selected one again
    REQUIRE(fixture.GetCounters() == "[2,0,1,11]");
}

TEST_CASE("D-7 execute_cmd: rl.exit ends and removes the console's program; a selected program is not affected")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(fixture, "rl.i move P,spd=2sec [40, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(fixture, "rl.start") == 200);
    fixture.clock.Advance(1s);
    REQUIRE(Command(fixture, "rl.exit") == 200);
    REQUIRE_FALSE(IsPlaying(fixture));
    fixture.clock.Advance(1s);
    REQUIRE(IsAt(fixture, "20"));
    REQUIRE(fixture.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(Command(fixture, "rl.exit") == 200);
    REQUIRE(IsPlaying(fixture));
    REQUIRE(fixture.GetCounters() == "[1,0,0,0]");
}

TEST_CASE("D-6 release_wait: ends the wait of the program; refused if no program waits")
{
    constexpr const char* RELEASE = "/project/context/tasks[0]/release_wait";
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.PostForCode(RELEASE) == "403 -104");
    REQUIRE(Command(fixture, "rl.i wait di1") == 200);
    REQUIRE(Command(fixture, "rl.i wait di2") == 200);
    REQUIRE(fixture.PostForCode(RELEASE) == "403 -104"); // it does not run
    REQUIRE(Command(fixture, "rl.start") == 200);
    REQUIRE(fixture.Post(RELEASE) == 200);
    REQUIRE(IsPlaying(fixture));
    REQUIRE(fixture.Post(RELEASE) == 200);
    REQUIRE_FALSE(IsPlaying(fixture));
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(fixture.PostForCode(RELEASE) == "403 -104");
}

TEST_CASE("A execute_cmd: an invalid command or statement is answered with ecode 1 and changes nothing")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    for (const char* line :
         {"",
          "rl",
          "rl.",
          "rl.i",
          "rl.i ",
          "rl.i wait",
          "rl.i wait ",
          "rl.i wait q1",
          "rl.i wait di99999",
          "rl.i end end",
          "rl.i move",
          "rl.i move P,spd=1sec [0,90,0,0,0,200]x",
          "rl.START",
          "reboot"})
    {
        INFO(line);
        CHECK_FALSE(IsKnown(fixture, line));
    }
    REQUIRE(fixture.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(IsKnown(fixture, "rl.i wait fb3.dob7"));
    REQUIRE(IsKnown(fixture, "rl.start"));
    REQUIRE_FALSE(IsKnown(fixture, "rl.i end")); // it runs
    REQUIRE(fixture.PostForCode("/console/execute_cmd", "{}") == "400 -1");
    REQUIRE(Command(fixture, std::string(1'001, 'r')) == 400);
}

TEST_CASE("A execute_cmd: a program has room for 1000 statements")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    for (int count = 0; count < 1'000; ++count)
    {
        REQUIRE(IsKnown(fixture, "rl.i wait di1"));
    }
    REQUIRE_FALSE(IsKnown(fixture, "rl.i wait di1"));
    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"di1","value":1})") == 200);
    REQUIRE(IsKnown(fixture, "rl.start"));
    REQUIRE_FALSE(IsPlaying(fixture)); // through all of them at once
}

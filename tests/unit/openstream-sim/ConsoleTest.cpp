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

int Command(ControllerFixture& harness, const std::string& line)
{
    return harness.Post("/console/execute_cmd", R"({"cmd_line":")" + line + R"("})");
}

bool IsKnown(ControllerFixture& harness, const std::string& line)
{
    const auto answer = harness.Call(EApiMethod::Post, "/console/execute_cmd", R"({"cmd_line":")" + line + R"("})");
    REQUIRE(answer.status == 200);
    return answer.body->GetText() == R"({"_type":"JObject"})";
}

std::string ExecuteMove(ControllerFixture& harness, const std::string& statement)
{
    return harness.PostForCode(MOVE_PATH, R"({"stmt":")" + statement + R"("})");
}

bool IsPlaying(ControllerFixture& harness)
{
    return harness.Contains("/project/rgen", R"("is_playback":1)");
}

bool IsAt(ControllerFixture& harness, const std::string& angle)
{
    return harness.Contains(JOINTS, "\"position\":[" + angle + "]");
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

TEST_CASE("A execute_move: what is no statement of the robot language is -1376272, and nothing moves")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
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
        CHECK(ExecuteMove(harness, statement) == "403 -1376272");
    }
    REQUIRE(harness.PostForCode(MOVE_PATH, "{}") == "400 -1");
    REQUIRE(ExecuteMove(harness, std::string(1'001, 'm')) == "400 -1");
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "0"));
}

TEST_CASE("A execute_move: the arm is there after its time and stands, in between it moves; stop ends it where it is")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(ExecuteMove(harness, "move P,spd=2sec,accu=0,tool=0 [40,90,0,0,0,0]") == "200");
    REQUIRE(IsAt(harness, "0"));
    REQUIRE_FALSE(IsPlaying(harness));
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "20"));
    REQUIRE(harness.Contains(JOINTS, R"("velocity":[30])")); // half as fast again as the mean
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "40"));
    REQUIRE(harness.Contains(JOINTS, R"("velocity":[0])"));
    REQUIRE(ExecuteMove(harness, "move P,spd=2sec [0,90,0,0,0,0]") == "200");
    harness.clock.Advance(1s);
    REQUIRE(harness.Post("/project/robot/stop") == 200);
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "20"));
    REQUIRE(ExecuteMove(harness, "move P,spd=2sec [20,90,0,0,0,0]") == "200"); // no way to go
    harness.clock.Advance(2s);
    REQUIRE(IsAt(harness, "20"));
}

TEST_CASE("A execute_move: no axis goes faster than it can; % counts of that, mm/sec of the flange's way")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(ExecuteMove(harness, "move P,spd=0.001sec [100,90,0,0,0,0]") == "200");
    harness.clock.Advance(375ms);
    REQUIRE(IsAt(harness, "50"));
    REQUIRE(harness.Contains(JOINTS, R"("velocity":[200])"));
    harness.clock.Advance(375ms);
    REQUIRE(IsAt(harness, "100"));
    REQUIRE(ExecuteMove(harness, "move P,spd=50% [0,90,0,0,0,0]") == "200");
    harness.clock.Advance(750ms);
    REQUIRE(IsAt(harness, "50"));
    REQUIRE(harness.Contains(JOINTS, R"("velocity":[-100])"));
    harness.clock.Advance(750ms);
    // 60 deg at a reach of 1070 mm: 1070 mm straight
    REQUIRE(ExecuteMove(harness, "move P,spd=535mm/sec [60,90,0,0,0,0]") == "200");
    harness.clock.Advance(1s);
    REQUIRE(harness.Contains(JOINTS, R"("position":[30)"));
    harness.clock.Advance(999ms);
    REQUIRE_FALSE(IsAt(harness, "60"));
    harness.clock.Advance(2ms);
    REQUIRE(IsAt(harness, "60"));
}

TEST_CASE("A execute_move: a program that was stopped in its middle is given up, and the next one starts from there")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(harness.Select(11) == 200);
    REQUIRE(harness.Start() == 200);
    harness.clock.Advance(1s);
    REQUIRE(harness.Post("/project/robot/stop") == 200);
    REQUIRE(ExecuteMove(harness, "move P,spd=1sec [40,90,0,0,0,0]") == "200");
    REQUIRE(harness.GetCounters() == "[1,0,1,11]");
    REQUIRE(harness.PostForCode("/project/robot/start") == "403 -1442080"); // moves
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "40"));
    REQUIRE(harness.Start() == 200);
    REQUIRE(IsAt(harness, "40"));
    harness.clock.Advance(2s);
    REQUIRE(harness.GetCounters() == "[2,1,1,11]");
}

TEST_CASE("A execute_cmd: moves and waits run one after the other, exactly in time, and end")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(harness, "rl.i move P,spd=1sec,accu=4,tool=0 [10, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(harness, "rl.i wait ml10") == 200);
    REQUIRE(Command(harness, "rl.i move P,spd=1sec,accu=4,tool=0 [-10, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(harness, "rl.i move P,spd=1sec,accu=4,tool=0 [0, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(harness, "rl.i end") == 200);
    REQUIRE(Command(harness, "rl.i move P,spd=1sec [99, 90, 0, 0, 0, 0]") == 200); // behind the end
    REQUIRE_FALSE(IsPlaying(harness));
    REQUIRE(Command(harness, "rl.start") == 200);
    REQUIRE(IsPlaying(harness));
    harness.clock.Advance(500ms);
    REQUIRE(IsAt(harness, "5"));
    harness.clock.Advance(9'500ms);
    REQUIRE(IsAt(harness, "10"));
    REQUIRE(harness.Contains("/project/robot/trajectory/joint_traject_ready", R"("ready":true)"));
    REQUIRE(harness.Post("/project/plc/set_relay_value", R"({"name":"ml10","value":7})") == 200);
    harness.clock.Advance(1'500ms); // in one step
    REQUIRE(IsAt(harness, "-5"));
    REQUIRE(harness.Contains("/project/robot/trajectory/joint_traject_ready", R"("ready":false)"));
    harness.clock.Advance(499ms);
    REQUIRE(IsPlaying(harness));
    harness.clock.Advance(1ms);
    REQUIRE_FALSE(IsPlaying(harness));
    REQUIRE(IsAt(harness, "0"));
    REQUIRE(harness.GetCounters() == "[0,0,0,0]"); // it has none of its own
}

TEST_CASE("A execute_cmd: rl.stop halts a move, start goes on with it, rl.reinit forgets the statements")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(harness, "rl.i move P,spd=2sec [40, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(harness, "rl.start") == 200);
    harness.clock.Advance(1s);
    REQUIRE(Command(harness, "rl.stop") == 200);
    REQUIRE_FALSE(IsPlaying(harness));
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "20"));
    REQUIRE(harness.Start() == 200);
    harness.clock.Advance(2s);
    REQUIRE(IsAt(harness, "40"));
    REQUIRE(harness.Start() == 200); // no program is selected: the console's, from its beginning
    REQUIRE(IsPlaying(harness));
    REQUIRE(Command(harness, "rl.reinit") == 200);
    REQUIRE_FALSE(IsPlaying(harness));
    REQUIRE(harness.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(harness.PostForCode("/project/robot/start") == "403 -3");
}

TEST_CASE("A execute_cmd: a selected program takes the place of the console's, which takes that of a halted one")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(harness, "rl.i wait di1") == 200);
    REQUIRE(Command(harness, "rl.start") == 200);
    REQUIRE(
        harness.PostForCode("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"ext_sel":1})") == "403 -1442080");
    REQUIRE(Command(harness, "rl.stop") == 200);
    REQUIRE(harness.Select(11) == 200);
    REQUIRE(harness.Start() == 200);
    REQUIRE(harness.GetCounters() == "[1,0,0,0]");
    harness.clock.Advance(1s);
    REQUIRE(Command(harness, "rl.stop") == 200);
    REQUIRE(Command(harness, "rl.start") == 200);
    REQUIRE(harness.GetCounters() == "[1,0,1,11]");
    REQUIRE(harness.Contains("/project/robot/trajectory/joint_traject_ready", R"("ready":true)"));
    REQUIRE(harness.Reset() == 200);
    REQUIRE_FALSE(IsPlaying(harness));
    REQUIRE(harness.Start() == 200); // the selected one again
    REQUIRE(harness.GetCounters() == "[2,0,1,11]");
}

TEST_CASE("D-7 execute_cmd: rl.exit ends the console's program and forgets it; a selected program is not touched")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(Command(harness, "rl.i move P,spd=2sec [40, 90, 0, 0, 0, 0]") == 200);
    REQUIRE(Command(harness, "rl.start") == 200);
    harness.clock.Advance(1s);
    REQUIRE(Command(harness, "rl.exit") == 200);
    REQUIRE_FALSE(IsPlaying(harness));
    harness.clock.Advance(1s);
    REQUIRE(IsAt(harness, "20"));
    REQUIRE(harness.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(harness.Select(11) == 200);
    REQUIRE(harness.Start() == 200);
    REQUIRE(Command(harness, "rl.exit") == 200);
    REQUIRE(IsPlaying(harness));
    REQUIRE(harness.GetCounters() == "[1,0,0,0]");
}

TEST_CASE("D-6 release_wait: the program leaves the wait at which it stands; refused where none waits")
{
    constexpr const char* RELEASE = "/project/context/tasks[0]/release_wait";
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    REQUIRE(harness.PostForCode(RELEASE) == "403 -104");
    REQUIRE(Command(harness, "rl.i wait di1") == 200);
    REQUIRE(Command(harness, "rl.i wait di2") == 200);
    REQUIRE(harness.PostForCode(RELEASE) == "403 -104"); // it does not run
    REQUIRE(Command(harness, "rl.start") == 200);
    REQUIRE(harness.Post(RELEASE) == 200);
    REQUIRE(IsPlaying(harness));
    REQUIRE(harness.Post(RELEASE) == 200);
    REQUIRE_FALSE(IsPlaying(harness));
    REQUIRE(harness.Select(11) == 200);
    REQUIRE(harness.Start() == 200);
    REQUIRE(harness.PostForCode(RELEASE) == "403 -104");
}

TEST_CASE("A execute_cmd: what is no command, or no statement, is answered with ecode 1 and changes nothing")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
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
        CHECK_FALSE(IsKnown(harness, line));
    }
    REQUIRE(harness.PostForCode("/console/execute_cmd", R"({"cmd_line":"rl.start"})") == "403 -3");
    REQUIRE(IsKnown(harness, "rl.i wait fb3.dob7"));
    REQUIRE(IsKnown(harness, "rl.start"));
    REQUIRE_FALSE(IsKnown(harness, "rl.i end")); // it runs
    REQUIRE(harness.PostForCode("/console/execute_cmd", "{}") == "400 -1");
    REQUIRE(Command(harness, std::string(1'001, 'r')) == 400);
}

TEST_CASE("A execute_cmd: a program has room for 1000 statements")
{
    ControllerFixture harness(ControllerFixture::MakeReadyOptions());
    for (int count = 0; count < 1'000; ++count)
    {
        REQUIRE(IsKnown(harness, "rl.i wait di1"));
    }
    REQUIRE_FALSE(IsKnown(harness, "rl.i wait di1"));
    REQUIRE(harness.Post("/project/plc/set_relay_value", R"({"name":"di1","value":1})") == 200);
    REQUIRE(IsKnown(harness, "rl.start"));
    REQUIRE_FALSE(IsPlaying(harness)); // through all of them at once
}

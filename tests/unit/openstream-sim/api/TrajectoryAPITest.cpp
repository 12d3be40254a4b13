#include "api/TrajectoryFixture.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>

namespace ACS::Testing::Trajectory
{

using namespace std::chrono_literals;
using OpenStream::ApiResponse;
using OpenStream::EApiMethod;
using OpenStreamSim::ControllerOptions;

TEST_CASE("C.1 A trajectory requires, checked in this order: remote mode, motor on, a waiting program in playback")
{
    for (const char* url : {INSERT_POINT, INSERT_POINTS})
    {
        INFO(url);
        const std::string body = url == INSERT_POINT ? GOOD_POINT : MakePair();
        ControllerFixture fixture(MakeIdleOptions());
        fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
        REQUIRE(fixture.PostForCode(url, body) == "403 -38500");
        fixture.controller.TurnModeSwitch(true, fixture.clock.GetNow());
        REQUIRE(fixture.PostForCode(url, body) == "403 -1442071");
        REQUIRE(fixture.Post("/project/robot/motor_on") == 200);
        fixture.clock.Advance(1s);
        REQUIRE(fixture.Contains("/project/robot", R"("alarm":-1)"));
        REQUIRE(fixture.PostForCode(url, body) == "403 -1554");
        REQUIRE(fixture.Contains("/project/robot", R"("alarm":1554)"));
        REQUIRE(fixture.Contains("/project/rgen", R"("eid_last_err":1554)"));
        REQUIRE(fixture.Select(11) == 200);
        REQUIRE(fixture.Start() == 200);
        REQUIRE(fixture.PostForCode(url, body) == "403 -1554"); // plays, but does not wait
        REQUIRE_FALSE(IsReady(fixture));
        fixture.clock.Advance(2s);
        REQUIRE(fixture.Post(COMMAND, R"({"cmd_line":"rl.i wait di1"})") == 200);
        REQUIRE(fixture.Post(COMMAND, R"({"cmd_line":"rl.start"})") == 200);
        REQUIRE(IsReady(fixture));
        REQUIRE(fixture.PostForCode(url, body) == "200");
        fixture.clock.Advance(2s);
        REQUIRE(GetFirstAngle(fixture) > 0.09);
        REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
    }
}

TEST_CASE("C.1 A driver brings the controller up from a cold start, as hdr_client_driver does")
{
    ControllerFixture fixture;
    REQUIRE(fixture.Post("/project/robot/motor_on") == 200);
    fixture.clock.Advance(5s);
    REQUIRE(fixture.Contains("/project/robot/motor_on_state", R"("val":0})"));
    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"fb0.di23","value":1})") == 200);
    REQUIRE(fixture.Post(INIT) == 200);
    for (const char* command : {"rl.stop", "rl.reinit", "rl.i wait di1", "rl.i end", "rl.start"})
    {
        INFO(command);
        const ApiResponse answer =
            fixture.Call(EApiMethod::Post, COMMAND, fmt::format(R"({{"cmd_line":"{}"}})", command));
        REQUIRE(answer.status == 200);
        REQUIRE(answer.body->GetText() == EMPTY_ANSWER);
    }
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":1)"));
    REQUIRE(fixture.PostForCode(INSERT_POINT, GOOD_POINT) == "200");
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == Approx(0.1).margin(1e-6));
}

TEST_CASE("C.1 With --playing a client needs nothing but joint_traject_init and its points")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Contains("/project/robot", R"("motor_on_state":0,"is_playback":1,"is_remote_mode":1)"));
    REQUIRE(fixture.Post(INIT) == 200);
    for (int number = 0; number < 500; ++number)
    {
        REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.02 * number, 0.002 * number, 0.04)) == 200);
        fixture.clock.Advance(2ms);
    }
    REQUIRE(fixture.Contains("/project/robot/joint_states", R"("velocity":[)"));
    REQUIRE(GetFirstAngle(fixture) == Approx(0.02 * (499 - 20) - 0.4).margin(0.1)); // look-ahead and lag behind
    REQUIRE(fixture.Contains("/project/robot/po_cur?crd=2", R"("j1":9.)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("in_position":[0,)"));
    REQUIRE(GetFree(fixture) == "2029");
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == Approx(9.98));
    REQUIRE(fixture.Contains("/project/rgen", R"("in_position":[1,)"));
}

TEST_CASE("C.4 STOP control clears the buffer and stops the arm; the program continues and accepts points at once")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(500ms);
    REQUIRE(IsMode(fixture));
    fixture.controller.StopControl(fixture.clock.GetNow());
    const double stopped = GetFirstAngle(fixture);
    REQUIRE(fixture.Contains(JOINT_STATES, R"("velocity":[0])"));
    REQUIRE(GetFree(fixture) == "2048");
    REQUIRE_FALSE(IsMode(fixture));
    REQUIRE(IsReady(fixture));
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == stopped);
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(stopped + 0.1, 0.0)) == 200);
}

TEST_CASE(
    "A joint_traject_init: empties the buffer in the middle of a motion, which stops; needs remote mode, not the motor")
{
    ControllerOptions options = MakeTrajectoryOptions();
    options.version = ControllerOptions{}.version;
    ControllerFixture fixture(options);
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(500ms);
    REQUIRE(fixture.Post(INIT) == 200);
    const double stopped = GetFirstAngle(fixture);
    REQUIRE(GetFree(fixture) == "2048");
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == stopped);
    fixture.controller.GetMachine(fixture.clock.GetNow()).SwitchMotorOff();
    REQUIRE(fixture.Post(INIT) == 200);
    fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
    REQUIRE(fixture.PostForCode(INIT) == "403 -38500");
}

TEST_CASE("A joint_traject_init: from 70.06 on it has no effect while joint_traject_mode is true")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(500ms);
    REQUIRE(fixture.Post(INIT, R"({"agility_mode":true})") == 200);
    REQUIRE(IsMode(fixture));
    REQUIRE(GetFree(fixture) == "2047");
    REQUIRE(fixture.Contains(AGILITY, R"("agility_mode":false)"));
    fixture.clock.Advance(2s);
    REQUIRE(GetFirstAngle(fixture) == Approx(28.648).margin(0.001)); // 0.5 rad
    REQUIRE_FALSE(IsMode(fixture));
    REQUIRE(fixture.Post(INIT, R"({"agility_mode":true})") == 200);
    REQUIRE(fixture.Contains(AGILITY, R"("agility_mode":true)"));
}

TEST_CASE("A joint_traject_init: before 70.04 it has no agility")
{
    ControllerOptions options = MakeTrajectoryOptions();
    options.version = {70, 3, 0};
    ControllerFixture fixture(options);
    REQUIRE(fixture.Post(INIT, R"({"agility_mode":true,"agility_freq":500})") == 200);
    REQUIRE_FALSE(fixture.controller.GetMachine(fixture.clock.GetNow()).GetTrajectory().GetAgility().bOn);
}

TEST_CASE("A Each endpoint is served from its first version on; an earlier controller answers with 404")
{
    struct Row
    {
        EApiMethod method;
        const char* path;
        ACS::OpenStreamSim::ControllerVersion first;
    };
    constexpr const char* EMERGENCY_STOP = "/project/robot/emergency_stop";
    const std::vector<Row> rows{
        {EApiMethod::Post, "/project/context/tasks[0]/execute_move", {60, 28, 0}},
        {EApiMethod::Post, COMMAND, {60, 28, 0}},
        {EApiMethod::Get, EMERGENCY_STOP, {60, 30, 0}},
        {EApiMethod::Post, EMERGENCY_STOP, {60, 30, 0}},
        {EApiMethod::Post, INIT, {60, 32, 0}},
        {EApiMethod::Post, INSERT_POINTS, {60, 32, 0}},
        {EApiMethod::Get, FREE, {60, 32, 0}},
        {EApiMethod::Post, INSERT_POINT, {60, 34, 0}},
        {EApiMethod::Get, JOINT_STATES, {60, 34, 0}},
        {EApiMethod::Get, "/project/robot/joint_states", {60, 34, 0}},
        {EApiMethod::Get, AGILITY, {70, 4, 0}},
        {EApiMethod::Get, LOG, {70, 4, 0}},
        {EApiMethod::Post, LOG, {70, 4, 0}},
        {EApiMethod::Get, MODE, {70, 6, 0}},
        {EApiMethod::Get, READY, {70, 6, 0}},
        {EApiMethod::Post, OFF, {70, 6, 0}}};
    for (const Row& row : rows)
    {
        INFO(row.path);
        ControllerOptions options;
        options.version = row.first;
        CHECK(ControllerFixture(options).Call(row.method, row.path).status != 404);
        options.version = {row.first.major, row.first.minor - 1, 99};
        CHECK(ControllerFixture(options).Call(row.method, row.path).status == 404);
    }
}

TEST_CASE("A joint_traject_init, joint_traject_agility_info: what is set is what is read, an empty body resets it")
{
    ControllerFixture fixture;
    REQUIRE(fixture.Get(AGILITY) == R"({"_type":"JObject","agility_mode":false,"agility_freq":20})");
    REQUIRE(fixture.Post(INIT, R"({"agility_mode":true,"agility_freq":30})") == 200);
    REQUIRE(fixture.Get(AGILITY) == R"({"_type":"JObject","agility_mode":true,"agility_freq":30})");
    for (const char* body :
         {R"({"agility_mode":1})",
          R"({"agility_mode":"true"})",
          R"({"agility_freq":501})",
          R"({"agility_freq":-1})",
          R"({"agility_freq":"NaN"})",
          R"({"agility_freq":[]})",
          "[]"})
    {
        INFO(body);
        REQUIRE(fixture.PostForCode(INIT, body) == "400 -1");
        REQUIRE(fixture.Contains(AGILITY, R"("agility_freq":30)"));
    }
    REQUIRE(fixture.Post(INIT) == 200);
    REQUIRE(fixture.Contains(AGILITY, R"("agility_mode":false,"agility_freq":20)"));
}

TEST_CASE(
    "A joint_traject_mode, joint_traject_off: active while it moves; off drops the rest, and agility is cleaned up for 0.5 s")
{
    for (const bool bAgile : {false, true})
    {
        ControllerFixture fixture(MakeTrajectoryOptions());
        REQUIRE(fixture.Post(INIT, fmt::format(R"({{"agility_mode":{},"agility_freq":100}})", bAgile)) == 200);
        REQUIRE_FALSE(IsMode(fixture));
        REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
        REQUIRE(IsMode(fixture));
        fixture.clock.Advance(500ms);
        REQUIRE(fixture.Post(OFF) == 200);
        REQUIRE(GetFree(fixture) == "2048");
        fixture.clock.Advance(490ms);
        REQUIRE(IsMode(fixture) == bAgile);
        REQUIRE(GetFirstAngle(fixture) == Approx(14.324).margin(0.001));
        fixture.clock.Advance(10ms);
        REQUIRE_FALSE(IsMode(fixture));
        REQUIRE(IsReady(fixture));
        REQUIRE(fixture.Post(OFF) == 200); // nothing to end
        fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
        REQUIRE(fixture.PostForCode(OFF) == "403 -38500");
    }
}

TEST_CASE("A joint_traject_log: POST sets it, GET returns it, a point that comes too early switches it off")
{
    ControllerFixture fixture(ControllerFixture::MakeReadyOptions());
    REQUIRE(fixture.Get(LOG) == R"({"_type":"JObject","val":0})");
    REQUIRE(fixture.Post(LOG, R"({"enable":true})") == 200);
    REQUIRE(fixture.Contains(LOG, R"("val":1)"));
    for (const char* body : {"{}", R"({"enable":1})", R"({"enable":null})", R"({"enable":"true"})", "[]"})
    {
        INFO(body);
        REQUIRE(fixture.PostForCode(LOG, body) == "400 -1");
    }
    REQUIRE(fixture.Contains(LOG, R"("val":1)"));
    REQUIRE(fixture.PostForCode(INSERT_POINT, GOOD_POINT) == "403 -1554");
    REQUIRE(fixture.Contains(LOG, R"("val":0)"));
}

TEST_CASE("C.1 What ends the playback stops the arm; what is left of the points must be cleared before new ones come")
{
    using Interruption = void (*)(ControllerFixture&);
    constexpr std::array<Interruption, 4> INTERRUPTIONS{
        [](ControllerFixture& fixture) { REQUIRE(fixture.Post("/project/robot/stop") == 200); },
        [](ControllerFixture& fixture) {
            fixture.controller.GetMachine(fixture.clock.GetNow()).SwitchMotorOff();
            REQUIRE(fixture.PostForCode(INSERT_POINT, GOOD_POINT) == "403 -1442071");
            REQUIRE(fixture.Post("/project/robot/motor_on") == 200);
        },
        [](ControllerFixture& fixture) {
            REQUIRE(fixture.Post("/project/robot/emergency_stop") == 200);
            REQUIRE(fixture.Post("/project/robot/emergency_stop", R"({"val":0})") == 200);
            REQUIRE(fixture.Post("/project/robot/motor_on") == 200);
        },
        [](ControllerFixture& fixture) {
            fixture.controller.TurnModeSwitch(false, fixture.clock.GetNow());
            REQUIRE(fixture.PostForCode(INSERT_POINT, GOOD_POINT) == "403 -38500");
            fixture.controller.TurnModeSwitch(true, fixture.clock.GetNow());
        }};
    for (const Interruption interrupt : INTERRUPTIONS)
    {
        ControllerFixture fixture(MakeTrajectoryOptions());
        REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
        fixture.clock.Advance(500ms);
        interrupt(fixture);
        const double stopped = GetFirstAngle(fixture);
        REQUIRE(fixture.Contains(JOINT_STATES, R"("velocity":[0])"));
        fixture.clock.Advance(2s);
        REQUIRE(GetFirstAngle(fixture) == stopped);
        REQUIRE(GetFree(fixture) == "2047");
        REQUIRE_FALSE(IsMode(fixture));
        REQUIRE(fixture.Start() == 200); // waits again
        REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(stopped)) == "403 -101");
        REQUIRE(fixture.Post(INIT) == 200);
        REQUIRE(fixture.Post(INSERT_POINT, MakePoint(stopped)) == 200);
    }
}

TEST_CASE("A joint_traject_ready: a point that comes while it is false raises E01554 and clears what a stop has left")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(500ms);
    REQUIRE(fixture.Post("/project/robot/stop") == 200);
    REQUIRE_FALSE(IsReady(fixture));
    REQUIRE(GetFree(fixture) == "2047");
    REQUIRE(fixture.PostForCode(INSERT_POINT, GOOD_POINT) == "403 -1554");
    REQUIRE(GetFree(fixture) == "2048");
    REQUIRE(fixture.Start() == 200);
    REQUIRE(IsReady(fixture));
}

TEST_CASE(
    "C.1 The wait ends when its relay is set; the arm then stops, and a program moves it from there without a jump")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(500ms);
    REQUIRE(fixture.Post("/project/plc/set_relay_value", R"({"name":"di1","value":1})") == 200);
    const double stopped = GetFirstAngle(fixture);
    fixture.clock.Advance(1s);
    REQUIRE(fixture.Contains("/project/rgen", R"("is_playback":0)"));
    REQUIRE(GetFirstAngle(fixture) == stopped);
    REQUIRE(fixture.Select(11) == 200);
    REQUIRE(fixture.Start() == 200);
    REQUIRE(GetFirstAngle(fixture) == stopped);
    fixture.clock.Advance(2s);
    REQUIRE(fixture.GetCounters() == "[1,1,0,11]");
    REQUIRE(fixture.Contains("/project/robot/joint_states", R"("velocity":[0,0,0,0,0,0])"));
    REQUIRE(GetFirstAngle(fixture) == Approx(0.0).margin(1e-9));
}

TEST_CASE("C.5 Gravity's effort follows the axes 2 and 3 in a trajectory")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    const std::string body = R"({"interval":1,"look_ahead_time":0,"point":[0,30,0,0,0,0]})";
    REQUIRE(fixture.Post(INSERT_POINT, body) == 200);
    fixture.clock.Advance(10s);
    REQUIRE(fixture.Contains("/project/robot/joint_states", R"("effort":[0,47.0000)"));
}

TEST_CASE("The time scale holds for trajectories, velocities are those that a client sees")
{
    ControllerOptions options = MakeTrajectoryOptions();
    options.timeScale = 10.0;
    ControllerFixture fixture(options);
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair()) == 200);
    fixture.clock.Advance(50ms);
    REQUIRE(GetFirstAngle(fixture) == Approx(28.6478897565 * 0.46).margin(0.001));
    REQUIRE(fixture.Contains(JOINT_STATES, R"("velocity":[286.4)"));
}

} // namespace ACS::Testing::Trajectory

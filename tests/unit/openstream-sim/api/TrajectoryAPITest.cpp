#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>

using namespace std::chrono_literals;
using ACS::OpenStream::ApiResponse;
using ACS::OpenStream::EApiMethod;
using ACS::OpenStreamSim::ControllerOptions;
using ACS::Testing::ControllerFixture;

namespace
{

constexpr const char* INIT = "/project/robot/trajectory/joint_traject_init";
constexpr const char* INSERT_POINT = "/project/robot/trajectory/joint_traject_insert_point";
constexpr const char* INSERT_POINTS = "/project/robot/trajectory/joint_traject_insert_points";
constexpr const char* FREE = "/project/robot/trajectory/joint_traject_buf_avail";
constexpr const char* AGILITY = "/project/robot/trajectory/joint_traject_agility_info";
constexpr const char* MODE = "/project/robot/trajectory/joint_traject_mode";
constexpr const char* READY = "/project/robot/trajectory/joint_traject_ready";
constexpr const char* OFF = "/project/robot/trajectory/joint_traject_off";
constexpr const char* LOG = "/project/robot/trajectory/joint_traject_log";
constexpr const char* COMMAND = "/console/execute_cmd";
constexpr const char* JOINT_STATES = "/project/robot/joints/joint_states?jno_start=1&jno_n=1";

constexpr const char* EMPTY_ANSWER = R"({"_type":"JObject"})";
constexpr const char* GOOD_POINT =
    R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0.1,90,0,0,0,0]})";

/// Of the first version that serves every endpoint.
ControllerOptions MakeIdleOptions()
{
    ControllerOptions options;
    options.version = ACS::OpenStreamSim::FIRST_WITH_TRAJECTORY_MODE;
    return options;
}

/// Likewise, and the motor is on and a program waits in playback.
ControllerOptions MakeTrajectoryOptions()
{
    ControllerOptions options = MakeIdleOptions();
    options.bWaiting = true;
    return options;
}

std::string MakePoint(double first, double time = -1.0, double lookAhead = 0.0)
{
    return fmt::format(
        R"({{"interval":0.002,"time_from_start":{},"look_ahead_time":{},"point":[{},90,0,0,0,0]}})",
        time,
        lookAhead,
        first);
}

/// Two points; the first is the initial position of the arm.
std::string MakePoints(const std::string& points)
{
    return R"({"joint_names":["j1","j2","j3","j4","j5","j6"],"points":{)" + points + "}}";
}

std::string MakeTimed(int number, double radians, double time)
{
    return fmt::format(
        R"("point_{}":{{"positions":[{},1.5707963267948966,0,0,0,0],"time_from_start":{}}})",
        number,
        radians,
        time);
}

std::string MakePair(double firstTime = 0.0, double lastTime = 1.0)
{
    return MakePoints(MakeTimed(1, 0.0, firstTime) + "," + MakeTimed(2, 0.5, lastTime));
}

/// The angle of axis 1.
double GetFirstAngle(ControllerFixture& fixture)
{
    const std::string text = fixture.Get(JOINT_STATES);
    constexpr std::string_view KEY = "\"position\":[";
    return std::stod(text.substr(text.find(KEY) + KEY.size()));
}

std::string GetFree(ControllerFixture& fixture)
{
    const std::string text = fixture.Get(FREE);
    constexpr std::string_view FRONT = R"({"_type":"JObject","val":)";
    REQUIRE(text.starts_with(FRONT));
    return text.substr(FRONT.size(), text.size() - FRONT.size() - 1);
}

bool IsMode(ControllerFixture& fixture)
{
    return fixture.Contains(MODE, R"("mode":true)");
}

bool IsReady(ControllerFixture& fixture)
{
    return fixture.Contains(READY, R"("ready":true)");
}

} // namespace

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

TEST_CASE("A joint_traject_insert_point: an invalid body is refused with 400, whatever the arm does")
{
    constexpr std::array BODIES{
        R"([])",
        R"({})",
        R"({"interval":"0.002","time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":0,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":-0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":1e300,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":null,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":"NaN","look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1e300,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":1e300,"look_ahead_time":0,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":-1,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":1e9,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":[],"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"point":[0,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":{}})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,"90",0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,null,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[180.1,90,0,0,0,0]})",
        R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0,90,0,0,0,1e308]})"};
    for (const bool bPlaying : {false, true})
    {
        ControllerFixture fixture(bPlaying ? MakeTrajectoryOptions() : MakeIdleOptions());
        for (const char* body : BODIES)
        {
            INFO(body);
            const ApiResponse answer = fixture.Call(EApiMethod::Post, INSERT_POINT, body);
            REQUIRE(answer.status == 400);
            REQUIRE(answer.body->GetText().find(R"("err_code":-1,"err_msg":")") != std::string::npos);
        }
        const std::string many = "[0" + std::string(200'000, ' ') + ",0]";
        REQUIRE(
            fixture.PostForCode(INSERT_POINT, R"({"interval":0.002,"look_ahead_time":0,"point":)" + many + "}")
            == "400 -1");
        REQUIRE(GetFree(fixture) == "2048");
        REQUIRE_FALSE(IsMode(fixture));
    }
}

TEST_CASE("7.43 time_from_start may be absent, negative, or rise; it does not go back while points are waiting")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    constexpr const char* ABSENT = R"({"interval":0.01,"look_ahead_time":5,"point":[0.1,90,0,0,0,0]})";
    REQUIRE(fixture.Post(INSERT_POINT, ABSENT) == 200);
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.2, -7.5)) == 200); // any negative number, not only -1
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.3, 0.014)) == 200);
    REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(0.4, 0.014)) == "400 -1"); // 10 + 2 + 2 ms
    REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(0.4, 0.0)) == "400 -1");
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.4, 0.016)) == 200);
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == Approx(0.4).margin(1e-6));
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.3, 0.0)) == 200); // it is stationary: a new trajectory
}

TEST_CASE("C.2 A 2049th point is refused with -8, the 2048 are driven")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    for (int number = 1; number <= 2048; ++number)
    {
        REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.01 * number, -1.0, 60.0)) == 200);
    }
    REQUIRE(GetFree(fixture) == "0");
    REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(1.0)) == "403 -8");
    REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePair(5.0, 6.0)) == "403 -8");
    fixture.clock.Advance(60s + 4'096ms);
    REQUIRE(GetFree(fixture) == "2048");
    fixture.clock.Advance(1s);
    REQUIRE(GetFirstAngle(fixture) == Approx(20.48).margin(1e-6));
}

TEST_CASE("A joint_traject_insert_points: each error has its code, and no point is accepted")
{
    const std::string names = R"("joint_names":["j1","j2","j3","j4","j5","j6"])";
    const std::string first = MakeTimed(1, 0.0, 0.0);
    const std::string second = MakeTimed(2, 0.5, 1.0);
    struct Mistake
    {
        std::string body;
        const char* code;
    };
    const std::vector<Mistake> mistakes{
        {"[]", "400 -1"},
        {"{}", "403 -2"},
        {"{\"points\":{" + first + "," + second + "}}", "403 -2"},
        {R"({"joint_names":"j1"})", "403 -3"},
        {R"({"joint_names":null})", "403 -3"},
        {R"({"joint_names":[]})", "403 -3"},
        {R"({"joint_names":["j1","j2","j3","j4","j5"]})", "403 -3"},
        {R"({"joint_names":["j1","j3","j2","j4","j5","j6"]})", "403 -3"},
        {R"({"joint_names":["x1","j2","j3","j4","j5","j6"]})", "403 -3"},
        {R"({"joint_names":[1,2,3,4,5,6]})", "403 -3"},
        {"{" + names + "}", "403 -4"},
        {"{" + names + R"(,"points":[]})", "403 -5"},
        {"{" + names + R"(,"points":null})", "403 -5"},
        {"{" + names + R"(,"points":7})", "403 -5"},
        {MakePoints(""), "403 -6"},
        {MakePoints(first), "403 -6"},
        {MakePoints(first + R"(,"point_3":{})"), "403 -5"},
        {MakePoints(first + R"(,"point_02":{})"), "403 -5"},
        {MakePoints(first + R"(,"p":{})"), "403 -5"},
        {MakePoints(first + R"(,"point_":{})"), "403 -5"},
        {MakePoints(first + "," + first), "403 -5"},
        {MakePoints(first + R"(,"point_2":[])"), "403 -9"},
        {MakePoints(first + R"(,"point_2":null)"), "403 -9"},
        {MakePoints(first + R"(,"point_2":{"time_from_start":1})"), "403 -10"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0],"time_from_start":1})"), "403 -11"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0,0],"time_from_start":1})"), "403 -11"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,"1.57",0,0,0,0],"time_from_start":1})"), "403 -11"},
        {MakePoints(first + R"(,"point_2":{"positions":{},"time_from_start":1})"), "403 -11"},
        {MakePoints(first + R"(,"point_2":{"positions":[4,1.57,0,0,0,0],"time_from_start":1})"), "403 -11"}, // 229 deg
        {MakePoints(first + R"(,"point_2":{"positions":[1e308,1.57,0,0,0,0],"time_from_start":1})"), "403 -11"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0]})"), "403 -12"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0],"time_from_start":"1"})"), "403 -13"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0],"time_from_start":-1})"), "403 -13"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0],"time_from_start":0})"), "403 -13"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0],"time_from_start":1e300})"), "403 -13"},
        {MakePoints(first + R"(,"point_2":{"positions":[0,1.57,0,0,0,0],"time_from_start":1e-300})"), "403 -13"},
        {MakePair(0.5), "403 -13"},                                      // from standstill at 0.0
        {MakePoints(MakeTimed(1, 0.1, 0.0) + "," + second), "403 -11"}}; // not its position
    for (const Mistake& mistake : mistakes)
    {
        INFO(mistake.body);
        ControllerFixture fixture(MakeTrajectoryOptions());
        CHECK(fixture.PostForCode(INSERT_POINTS, mistake.body) == mistake.code);
        CHECK(GetFree(fixture) == "2048");
        fixture.clock.Advance(1s);
        CHECK(fixture.Contains("/project/robot/joint_states", R"("position":[0,90,0,0,0,0])"));
    }
}

TEST_CASE("A joint_traject_insert_points: 2048 points are accepted, 2049 and 100,000 are refused with -7")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    const auto makeMany = [](int count) {
        std::string points;
        for (int number = count; number >= 1; --number) // in any order
        {
            points += MakeTimed(number, 0.0001 * (number - 1), 0.01 * (number - 1)) + (number > 1 ? "," : "");
        }
        return MakePoints(points);
    };
    REQUIRE(fixture.PostForCode(INSERT_POINTS, makeMany(2049)) == "403 -7");
    std::string huge;
    for (int number = 1; number <= 100'000; ++number)
    {
        huge += fmt::format("{}\"point_{}\":0", number > 1 ? "," : "", number);
    }
    REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePoints(huge)) == "403 -7");
    REQUIRE(fixture.PostForCode(INSERT_POINTS, makeMany(2048)) == "200");
    REQUIRE(GetFree(fixture) == "1"); // it is already at the first one
    fixture.clock.Advance(21s);
    REQUIRE(GetFirstAngle(fixture) == Approx(0.2047 * 180.0 / 3.14159265358979).margin(1e-6));
}

TEST_CASE(
    "A joint_traject_insert_points: straight between the points, radians, velocities ignored, times continue while it moves")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    const std::string body = MakePoints(
        R"("point_2":{"positions":[0.5,1.570796,0,0,0,0],"velocities":["?"],"accelerations":7,"time_from_start":1.0},)"
        R"("point_1":{"positions":[0,1.570796,0,0,0,0],"time_from_start":0.0})");
    REQUIRE(fixture.Post(INSERT_POINTS, body) == 200);
    fixture.clock.Advance(500ms);
    constexpr double DEGREES = 28.6478897565;
    REQUIRE(GetFirstAngle(fixture) == Approx(DEGREES * (0.5 - 0.04)).margin(0.001));
    REQUIRE(fixture.Contains(JOINT_STATES, R"("velocity":[28.64)"));
    REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePair(0.0, 1.0)) == "403 -13"); // it moves
    REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePair(1.0, 2.0)) == "403 -13"); // not after the last
    REQUIRE(fixture.Post(INSERT_POINTS, MakePoints(MakeTimed(1, 0.5, 2.0) + "," + MakeTimed(2, 0.0, 3.0))) == 200);
    fixture.clock.Advance(1s); // 1.5: holds
    REQUIRE(GetFirstAngle(fixture) == Approx(DEGREES).margin(0.001));
    fixture.clock.Advance(1s); // 2.5: on the way back
    REQUIRE(GetFirstAngle(fixture) == Approx(DEGREES * (0.5 + 0.04)).margin(0.001));
    fixture.clock.Advance(2s);
    REQUIRE(GetFirstAngle(fixture) == Approx(0.0).margin(0.001));
    REQUIRE(fixture.Post(INSERT_POINTS, MakePair(0.0, 1.0)) == 200); // stationary: from 0 again
}

TEST_CASE("C.3 Too fast an axis raises E159 and stops the arm; points are refused until joint_traject_init")
{
    ControllerFixture fixture(MakeTrajectoryOptions());
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(0.2)) == 200);
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(5.0)) == 200); // 2400 deg/s
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(5.1)) == 200);
    fixture.clock.Advance(10ms);
    REQUIRE(fixture.Contains("/project/robot", R"("alarm":159)"));
    REQUIRE(fixture.Contains("/project/rgen", R"("eid_last_err":159)"));
    REQUIRE(fixture.Contains(JOINT_STATES, R"("velocity":[0])"));
    const double stopped = GetFirstAngle(fixture);
    REQUIRE(stopped > 0.0);
    REQUIRE(stopped < 0.2);
    REQUIRE(GetFree(fixture) == "2046");
    REQUIRE_FALSE(IsReady(fixture));
    REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(stopped)) == "403 -159");
    REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePair()) == "403 -159");
    REQUIRE(GetFree(fixture) == "2046");
    REQUIRE(fixture.Post(INIT) == 200);
    REQUIRE(GetFree(fixture) == "2048");
    REQUIRE(fixture.Contains("/project/robot", R"("alarm":-1)"));
    REQUIRE(GetFirstAngle(fixture) == stopped);
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(stopped)) == 200);
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

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
    if (GENERATE(false, true))
    {
        fixture.controller.StopControl(fixture.clock.GetNow()); // drops the points, and leaves the alarm
        REQUIRE(GetFree(fixture) == "2048");
        REQUIRE(fixture.Contains("/project/robot", R"("alarm":159)"));
        REQUIRE_FALSE(IsReady(fixture));
        REQUIRE(fixture.PostForCode(INSERT_POINT, MakePoint(stopped)) == "403 -159");
        REQUIRE(fixture.PostForCode(INSERT_POINTS, MakePair()) == "403 -159");
        REQUIRE(GetFree(fixture) == "2048");
    }
    REQUIRE(fixture.Post(INIT) == 200);
    REQUIRE(IsReady(fixture));
    REQUIRE(GetFree(fixture) == "2048");
    REQUIRE(fixture.Contains("/project/robot", R"("alarm":-1)"));
    REQUIRE(GetFirstAngle(fixture) == stopped);
    REQUIRE(fixture.Post(INSERT_POINT, MakePoint(stopped)) == 200);
}

} // namespace ACS::Testing::Trajectory

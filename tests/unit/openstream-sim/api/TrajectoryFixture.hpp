#pragma once

#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

/// Requests of the trajectory endpoints, and what they show.
namespace ACS::Testing::Trajectory
{

inline constexpr const char* INIT = "/project/robot/trajectory/joint_traject_init";
inline constexpr const char* INSERT_POINT = "/project/robot/trajectory/joint_traject_insert_point";
inline constexpr const char* INSERT_POINTS = "/project/robot/trajectory/joint_traject_insert_points";
inline constexpr const char* FREE = "/project/robot/trajectory/joint_traject_buf_avail";
inline constexpr const char* AGILITY = "/project/robot/trajectory/joint_traject_agility_info";
inline constexpr const char* MODE = "/project/robot/trajectory/joint_traject_mode";
inline constexpr const char* READY = "/project/robot/trajectory/joint_traject_ready";
inline constexpr const char* OFF = "/project/robot/trajectory/joint_traject_off";
inline constexpr const char* LOG = "/project/robot/trajectory/joint_traject_log";
inline constexpr const char* COMMAND = "/console/execute_cmd";
inline constexpr const char* JOINT_STATES = "/project/robot/joints/joint_states?jno_start=1&jno_n=1";

inline constexpr const char* EMPTY_ANSWER = R"({"_type":"JObject"})";
inline constexpr const char* GOOD_POINT =
    R"({"interval":0.002,"time_from_start":-1,"look_ahead_time":0,"point":[0.1,90,0,0,0,0]})";

/// Of the first version that serves every endpoint.
inline OpenStreamSim::ControllerOptions MakeIdleOptions()
{
    OpenStreamSim::ControllerOptions options;
    options.version = OpenStreamSim::FIRST_WITH_TRAJECTORY_MODE;
    return options;
}

/// Likewise, and the motor is on and a program waits in playback.
inline OpenStreamSim::ControllerOptions MakeTrajectoryOptions()
{
    OpenStreamSim::ControllerOptions options = MakeIdleOptions();
    options.bWaiting = true;
    return options;
}

inline std::string MakePoint(double first, double time = -1.0, double lookAhead = 0.0)
{
    return fmt::format(
        R"({{"interval":0.002,"time_from_start":{},"look_ahead_time":{},"point":[{},90,0,0,0,0]}})",
        time,
        lookAhead,
        first);
}

/// Two points; the first is the initial position of the arm.
inline std::string MakePoints(const std::string& points)
{
    return R"({"joint_names":["j1","j2","j3","j4","j5","j6"],"points":{)" + points + "}}";
}

inline std::string MakeTimed(int number, double radians, double time)
{
    return fmt::format(
        R"("point_{}":{{"positions":[{},1.5707963267948966,0,0,0,0],"time_from_start":{}}})",
        number,
        radians,
        time);
}

inline std::string MakePair(double firstTime = 0.0, double lastTime = 1.0)
{
    return MakePoints(MakeTimed(1, 0.0, firstTime) + "," + MakeTimed(2, 0.5, lastTime));
}

/// The angle of axis 1.
inline double GetFirstAngle(ControllerFixture& fixture)
{
    const std::string text = fixture.Get(JOINT_STATES);
    constexpr std::string_view KEY = "\"position\":[";
    return std::stod(text.substr(text.find(KEY) + KEY.size()));
}

inline std::string GetFree(ControllerFixture& fixture)
{
    const std::string text = fixture.Get(FREE);
    constexpr std::string_view FRONT = R"({"_type":"JObject","val":)";
    REQUIRE(text.starts_with(FRONT));
    return text.substr(FRONT.size(), text.size() - FRONT.size() - 1);
}

inline bool IsMode(ControllerFixture& fixture)
{
    return fixture.Contains(MODE, R"("mode":true)");
}

inline bool IsReady(ControllerFixture& fixture)
{
    return fixture.Contains(READY, R"("ready":true)");
}

} // namespace ACS::Testing::Trajectory

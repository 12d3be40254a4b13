#pragma once

#include <acs/plan/Report.hpp>
#include <acs/plan/RobotCommand.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace ACS::Planning
{

// Error codes of the alarms that the engine raises.
inline constexpr std::string_view ALARM_INTERRUPTED = "ACS-1001"; ///< A plan cannot continue after a restart.
inline constexpr std::string_view ALARM_LINK_LOST = "ACS-1002";   ///< No connection to the robot.
inline constexpr std::string_view ALARM_PLACE =
    "ACS-1003"; ///< The robot's node is unknown or reserved for another robot.
inline constexpr std::string_view ALARM_PORT = "ACS-1004";       ///< A job contradicts the record of the ports.
inline constexpr std::string_view ALARM_STORE = "ACS-1005";      ///< The store fails.
inline constexpr std::string_view ALARM_DROPPED = "ACS-1007";    ///< A job was stopped after its start.
inline constexpr std::string_view ALARM_UNRESOLVED = "ACS-1008"; ///< The outcome of a job is unknown.
inline constexpr std::string_view ALARM_STALL = "ACS-1009";      ///< A drive makes no progress.
inline constexpr std::string_view ALARM_CHARGE = "ACS-1010";     ///< The robot does not charge.
inline constexpr std::string_view ALARM_LOADS = "ACS-1011";      ///< Reported loads contradict the record of the ports.
inline constexpr std::string_view ALARM_REJECTIONS = "ACS-1012"; ///< The robot rejects its commands.
inline constexpr std::string_view ALARM_INCOMPATIBLE = "ACS-1013"; ///< The robot cannot do what it will be commanded.
inline constexpr std::string_view ALARM_ERRORS = "ACS-1014";       ///< More errors of a robot than alarms may be set.
inline constexpr std::string_view ALARM_WAIT = "ACS-1015";         ///< A robot waits for others that make no progress.
inline constexpr std::string_view ALARM_OUTBOX = "ACS-1020";       ///< Too many reports without an acknowledgement.
inline constexpr std::string_view ALARM_STORE_LOG = "ACS-1021";    ///< The log of the store cannot be merged.
/// Prefix of the engine's codes. Alarms without it are errors that robots reported.
inline constexpr std::string_view ALARM_PREFIX = "ACS-";
/// The robotID of alarms about the engine itself.
inline constexpr std::string_view OWN_ROBOT_ID = "ACS";

[[nodiscard]] inline Alarm MakeAlarm(
    std::string_view robotID,
    std::string_view errorCode,
    EAlarmLevel level,
    std::string message)
{
    Alarm alarm;
    alarm.robotID = robotID;
    alarm.errorCode = errorCode;
    alarm.level = level;
    alarm.message = std::move(message);
    return alarm;
}

[[nodiscard]] inline Alarm MakeLinkAlarm(std::string_view robotID, std::string message)
{
    return MakeAlarm(robotID, ALARM_LINK_LOST, EAlarmLevel::Heavy, std::move(message));
}

/// Names the job in the alarm.
inline void AddJob(Alarm& alarm, const StartJob& job)
{
    alarm.planID = job.planID;
    alarm.stepNo = job.stepNo;
    alarm.jobID = job.jobID;
}

} // namespace ACS::Planning

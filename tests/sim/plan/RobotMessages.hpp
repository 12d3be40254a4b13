#pragma once

#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Simulation
{

/// The greeting of a new adapter: every later snapshot shows that the robot has received it.
struct Greeting
{
    std::uint64_t number = 0;
};

struct PauseRequest
{
    std::uint64_t number = 0; ///< The highest is the valid one.
    bool bPause = false;
};

/// Names the command, because several jobs may have one jobID.
struct JobCancellation
{
    std::string commandID;
};

/// From an adapter to its robot. May be sent again: a robot executes each drive, job and request once.
using RobotMessage = std::variant<
    Greeting,
    Planning::Drive,
    Planning::ExtendDrive,
    Planning::CancelDrive,
    Planning::StartJob,
    JobCancellation,
    PauseRequest>;

enum class EDriveState : std::uint8_t
{
    Driving,
    Arrived,
    Cancelled,
    Rejected,
};

struct DriveView
{
    EDriveState state = EDriveState::Driving;
    std::size_t passedCount = 0; ///< Nodes of the route, including the first.
    std::size_t releasedCount = 0;
    std::string nodeID; ///< Where the drive ended.
};

enum class EJobState : std::uint8_t
{
    Waiting,
    Running,
    Finished,
    Failed,
};

struct JobView
{
    std::string jobID;
    EJobState state = EJobState::Waiting;
    std::string reason;
};

/// The complete state of a robot, sent on every change.
struct RobotSnapshot
{
    std::uint64_t greeting = 0;
    std::uint64_t pauseRequest = 0;
    Planning::StateChanged state;
    std::string activeDriveID;               ///< Empty: none.
    std::vector<std::string> aheadNodeIDs;   ///< Nodes that it may still drive to.
    std::string activeCommandID;             ///< Of a job that waits or runs; empty: none.
    std::string lastCommandID;               ///< Of the latest drive or job; empty: none, or forgotten.
    std::map<std::string, DriveView> drives; ///< All drives that were commanded, by driveID.
    std::map<std::string, JobView> jobs;     ///< Likewise, by commandID.
};

} // namespace ACS::Simulation

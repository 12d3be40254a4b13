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

/// A new adapter greets: every snapshot after it says that it has heard of it.
struct Greeting
{
    std::uint64_t number = 0;
};

struct PauseRequest
{
    std::uint64_t number = 0; ///< The highest counts.
    bool bPause = false;
};

/// Names the command, as several jobs may have one jobID.
struct JobCancellation
{
    std::string commandID;
};

/// From an adapter to its robot. May be sent again: a robot takes each drive, each job and each wish once.
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
    std::size_t passedCount = 0; ///< Nodes of the route, the first included.
    std::size_t releasedCount = 0;
    std::string nodeID; ///< Where it ended.
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

/// All that a robot says of itself, on every change.
struct RobotSnapshot
{
    std::uint64_t greeting = 0;
    std::uint64_t pauseRequest = 0;
    Planning::StateChanged state;
    std::string activeDriveID;               ///< Empty: none.
    std::vector<std::string> aheadNodeIDs;   ///< On which it may still drive.
    std::string activeCommandID;             ///< Of a job that waits or runs; empty: none.
    std::string lastCommandID;               ///< Of the drive or job that it was given last; empty: none, or forgotten.
    std::map<std::string, DriveView> drives; ///< Every one that it was given, by driveID.
    std::map<std::string, JobView> jobs;     ///< Likewise, by commandID.
};

} // namespace ACS::Simulation

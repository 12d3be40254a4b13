#pragma once

#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/IJobCheck.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// An active error of a robot.
struct RobotError
{
    std::string errorCode;                  ///< As it is reported to the MCS ("AGV-…", "ARM-…").
    EAlarmLevel level = EAlarmLevel::Light; ///< Heavy: the robot is given no work while the error is active.
    std::string message;                    ///< For the operator, as the robot states it.

    bool operator==(const RobotError&) const = default;
};

/// The robot was connected or disconnected. A new connection does not make its position known: StateChanged does.
struct LinkChanged
{
    bool bOnline = false; ///< Whether commands can reach the robot.

    bool operator==(const LinkChanged&) const = default;
};

/// What the robot's own sensors show at one of its carrier ports.
struct PortLoad
{
    std::string port;      ///< A port of RobotOptions::ports ("LR01.CP01").
    bool bLoaded = false;  ///< Whether a carrier is there.
    std::string carrierID; ///< Empty if the port is empty or the robot does not know the id.

    bool operator==(const PortLoad&) const = default;
};

/// What the robot shows of its commands. After a restart of the ACS the engine recognises by it which jobs were done. The default
/// shows nothing: the adapter answers each RecoverJob with JobUnresolved, and an operator resolves that job. Jobs that were done
/// while the store failed are not recognised then, and are commanded again.
struct RestartEvidence
{
    /// The last Drive or StartJob that the robot shows; empty if it shows none, for example after it was switched off. nullopt
    /// if robots of its kind never show one.
    std::optional<std::string> commandID{};
    /// A value of the adapter's own that differs once a further job has begun, such as an arm's counters. The engine stores it
    /// with the command and returns it in StartJob::progressToken. Empty if commandID is enough, or while it is unknown. The state
    /// must have a heavy error then, so that the robot gets no work.
    std::string progressToken{};

    bool operator==(const RestartEvidence&) const = default;
};

/// The current state of the robot. Raised on every change and for every state message of the robot. A pose with a number that is not
/// finite counts as unknown. A batteryPercent that is not finite keeps the former value, 0 without one; others are limited to 0 to 100.
struct StateChanged
{
    double x = 0;              ///< Metres.
    double y = 0;              ///< Metres.
    double theta = 0;          ///< Radians.
    bool bPoseKnown = false;   ///< Whether x, y and theta are valid (the robot is localised).
    double batteryPercent = 0; ///< 0 to 100.
    std::string lastNodeID;    ///< The current or last passed node; empty: unknown.
    bool bDriving = false;     ///< Whether it moves.
    bool bCharging = false;    ///< Whether its battery is being charged.
    bool bPaused = false;      ///< Whether it has stopped on Pause, or was paused at the robot.
    bool bAutomatic = true;    ///< The ACS controls it: VDA5050 AUTOMATIC or SEMIAUTOMATIC, Hi6 remote and automatic.
    bool bSafetyStop = false;  ///< Emergency stop, or the protective field is violated.
    bool bOccupied = false;    ///< Executes work of another controller, or work commanded before a restart.
    std::vector<RobotError> errors; ///< All active errors, or the most severe of them.
    std::size_t omittedErrors = 0;  ///< Number of active errors that are not in errors.
    /// Nodes ahead that the robot may still enter without a further command, because of an order from before a restart or of
    /// another controller. The engine reserves them for it.
    std::vector<std::string> heldNodeIDs;
    RestartEvidence restartEvidence; ///< As of this state.
    /// One entry per carrier port of RobotOptions::ports, by its name; others are ignored. nullopt if the robot reports no loads. The
    /// state with the loads after a job precedes its JobFinished.
    std::optional<std::vector<PortLoad>> loads;

    bool operator==(const StateChanged&) const = default;
};

/// The robot has passed or reached a node of the drive. Raised once for every node, in the order of the route: for the first
/// node when the robot has accepted the drive, for the last one before Arrived.
struct NodePassed
{
    std::string driveID;
    std::string nodeID;

    bool operator==(const NodePassed&) const = default;
};

/// The robot has stopped on the last node of the drive.
struct Arrived
{
    std::string driveID;

    bool operator==(const Arrived&) const = default;
};

/// The robot has rejected or abandoned the drive. It has stopped and keeps nothing of it. The engine commands another drive from
/// where the robot is then, until the robot has rejected too many commands in a row (EngineOptions::maximumRejections).
struct DriveRejected
{
    std::string driveID;
    std::string reason;

    bool operator==(const DriveRejected&) const = default;
};

/// The answer to CancelDrive: the robot has stopped on the node or after it. Arrived is raised instead if the robot reached
/// the target first.
struct DriveCancelled
{
    std::string driveID;
    std::string nodeID; ///< The last node of the drive that the robot has passed or is on.

    bool operator==(const DriveCancelled&) const = default;
};

/// The robot has begun the job.
struct JobStarted
{
    std::string jobID;

    bool operator==(const JobStarted&) const = default;
};

/// The job is done. May be raised without a JobStarted before; a job without one for EngineOptions::stallTimeout raises ACS-1009.
struct JobFinished
{
    std::string jobID;

    bool operator==(const JobFinished&) const = default;
};

/// The robot has ended the job with a fault, or because of CancelJob, and will not continue it.
struct JobFailed
{
    std::string jobID;
    std::string reason;

    bool operator==(const JobFailed&) const = default;
};

/// The robot has rejected the job and will not execute it. The engine commands it again, with the same commandID, until the robot
/// has rejected too many commands in a row (EngineOptions::maximumRejections).
struct JobRejected
{
    std::string jobID;
    std::string reason;

    bool operator==(const JobRejected&) const = default;
};

/// The robot has ended the job before it was done, without a fault: its mode was switched, or it was restarted. It shows that
/// nothing was moved. The engine commands the job once more, with another commandID. A robot that does not show whether the job
/// was done raises JobUnresolved instead.
struct JobInterrupted
{
    std::string jobID;
    std::string reason;

    bool operator==(const JobInterrupted&) const = default;
};

/// The robot shows that it never received the job: it can be commanded again without the risk of a second execution.
struct JobUnknown
{
    std::string jobID;

    bool operator==(const JobUnknown&) const = default;
};

/// The outcome of the job cannot be known from the robot: the operator has to check the floor and resolve it. The adapter
/// raises no further event of this job.
struct JobUnresolved
{
    std::string jobID;
    std::string reason; ///< What the robot shows, in a sentence for the operator.

    bool operator==(const JobUnresolved&) const = default;
};

/// The set of jobs that the robot can execute has changed, for example by a factsheet. Plans that no robot has are checked
/// with it; a plan that it rejects is not given to the robot. Stays in effect while the robot is disconnected.
struct JobCheckChanged
{
    std::shared_ptr<const IJobCheck> jobCheck; ///< Null (initial value): no job is rejected.

    bool operator==(const JobCheckChanged&) const = default;
};

/// Whether the robot can carry out what the engine will command has become known, for example by a factsheet. An incompatible
/// robot is unavailable and has an alarm (ACS-1013) until the adapter reports it compatible. Stays in effect while the robot is
/// disconnected.
struct CompatibilityChanged
{
    /// Why the robot is incompatible, and what to correct, in sentences for the operator. Empty (initial value): compatible.
    std::string incompatibility;

    bool operator==(const CompatibilityChanged&) const = default;
};

/// What an adapter reports about its robot. Events of another drive or job than the current one are ignored. An event that
/// ends a drive or job is raised once (one-end in docs/guide/write-an-adapter.md); others may be repeated.
using RobotEvent = std::variant<
    LinkChanged,
    StateChanged,
    NodePassed,
    Arrived,
    DriveRejected,
    DriveCancelled,
    JobStarted,
    JobFinished,
    JobFailed,
    JobRejected,
    JobInterrupted,
    JobUnknown,
    JobUnresolved,
    JobCheckChanged,
    CompatibilityChanged>;

} // namespace ACS::Planning

#pragma once

#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/IJobCheck.hpp>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// An error that a robot has at present.
struct RobotError
{
    std::string errorCode;                  ///< As the MCS will see it ("AGV-…", "ARM-…").
    EAlarmLevel level = EAlarmLevel::Light; ///< Heavy: the robot takes no work while it lasts.
    std::string message;

    bool operator==(const RobotError&) const = default;
};

/// The robot has come into reach or gone out of it. A new link says nothing about the robot's place.
struct LinkChanged
{
    bool bOnline = false;

    bool operator==(const LinkChanged&) const = default;
};

/// What the robot's own sensors show at one of its carrier ports.
struct PortLoad
{
    std::string port;      ///< A port of RobotOptions::ports ("LR01.CP01").
    bool bLoaded = false;  ///< Whether a carrier is there.
    std::string carrierID; ///< Its id; empty: the robot does not know it, or the port is empty.

    bool operator==(const PortLoad&) const = default;
};

/// What the robot shows of its commands. After a restart of the ACS the engine recognises by it which jobs were done. The default
/// shows nothing: each job in progress at a crash becomes unresolved.
struct RestartEvidence
{
    /// The last Drive or StartJob that the robot shows; empty if it shows none, for example after it was switched off. nullopt
    /// if robots of its kind never show one.
    std::optional<std::string> commandID{};
    /// A value of the adapter's own that differs once a further job has begun, such as an arm's counters. The engine stores it
    /// with the command and returns it in StartJob::progressToken. Empty if commandID is enough.
    std::string progressToken{};

    bool operator==(const RestartEvidence&) const = default;
};

/// The robot's present state; raised on every change, as often as the robot tells.
struct StateChanged
{
    double x = 0;              ///< Metres.
    double y = 0;              ///< Metres.
    double theta = 0;          ///< Radians.
    bool bPoseKnown = false;   ///< Whether x, y and theta say anything (localised).
    double batteryPercent = 0; ///< 0 to 100.
    std::string lastNodeID;    ///< The node it stands on or has passed last; empty: not known.
    bool bDriving = false;
    bool bCharging = false;
    bool bPaused = false;
    bool bAutomatic = true;   ///< Under our control: VDA5050 AUTOMATIC or SEMIAUTOMATIC, Hi6 remote and automatic.
    bool bSafetyStop = false; ///< Emergency stop or protective field.
    bool bOccupied = false;   ///< Busy with work that the engine did not give it, or gave it before a restart.
    std::vector<RobotError> errors; ///< All that are active.
    /// Nodes ahead on which it may still drive without another command, of an order that it was given before a restart or
    /// by somebody else: they are kept free for it.
    std::vector<std::string> heldNodeIDs;
    RestartEvidence restartEvidence;
    /// One entry per carrier port, in the order of RobotOptions::ports. Absent where the robot reports no loads.
    std::optional<std::vector<PortLoad>> loads;

    bool operator==(const StateChanged&) const = default;
};

/// The robot has passed or reached a node of the drive. Raised once for every node in the order of the route, the
/// first one included: that one as soon as the robot has accepted the drive. The last one before Arrived.
struct NodePassed
{
    std::string driveID;
    std::string nodeID;

    bool operator==(const NodePassed&) const = default;
};

/// The robot stands on the last node of the drive.
struct Arrived
{
    std::string driveID;

    bool operator==(const Arrived&) const = default;
};

/// The robot does not do the drive, or gave it up: it stands where it stands.
struct DriveRejected
{
    std::string driveID;
    std::string reason;

    bool operator==(const DriveRejected&) const = default;
};

/// The answer to CancelDrive: the robot stands, on the node or past it. Arrived instead: it was too late.
struct DriveCancelled
{
    std::string driveID;
    std::string nodeID; ///< The last node of the drive that it passed or stands on.

    bool operator==(const DriveCancelled&) const = default;
};

struct JobStarted
{
    std::string jobID;

    bool operator==(const JobStarted&) const = default;
};

/// May come without JobStarted before it.
struct JobFinished
{
    std::string jobID;

    bool operator==(const JobFinished&) const = default;
};

struct JobFailed
{
    std::string jobID;
    std::string reason;

    bool operator==(const JobFailed&) const = default;
};

/// The robot shows that it never had the job: it can be commanded (again) without being done twice.
struct JobUnknown
{
    std::string jobID;

    bool operator==(const JobUnknown&) const = default;
};

/// What became of the job cannot be known from the robot: a person has to look. The last word about this job: the adapter
/// tells nothing of it any more.
struct JobUnresolved
{
    std::string jobID;
    std::string reason; ///< What the robot shows, in words for that person.

    bool operator==(const JobUnresolved&) const = default;
};

/// What is known of the jobs that the robot can do has changed, as with a vehicle's factsheet. Plans that no robot has are
/// checked with it, and those that it rejects are not given to the robot. Stays in effect while the robot is out of reach.
struct JobCheckChanged
{
    std::shared_ptr<const IJobCheck> jobCheck; ///< Null, as before the first one: no job is rejected.

    bool operator==(const JobCheckChanged&) const = default;
};

/// What an adapter tells the engine about its robot. What does not belong to the present drive or job is ignored, so
/// an adapter may repeat itself.
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
    JobUnknown,
    JobUnresolved,
    JobCheckChanged>;

} // namespace ACS::Planning

#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// A node on the way, as the robot's vehicle type sees it.
struct RouteNode
{
    std::string nodeID;
    double x = 0;                ///< Metres.
    double y = 0;                ///< Metres.
    std::optional<double> theta; ///< Radians; absent: any.
    std::string mapID;           ///< May be empty.
    /// Metres: so near to it the node counts as reached. At most half of what the nearest other node is away.
    double allowedDeviation = 0.5;

    bool operator==(const RouteNode&) const = default;
};

/// An edge on the way, as the robot's vehicle type sees it.
struct RouteEdge
{
    std::string edgeID;
    std::string startNodeID;
    std::string endNodeID;
    double length = 0;                      ///< Metres, as the crow flies.
    std::optional<double> maxSpeed;         ///< Metres per second.
    std::optional<double> maxRotationSpeed; ///< Radians per second.
    std::optional<double> orientation;      ///< Radians; how the vehicle is turned while it drives along the edge.
    std::string orientationType;            ///< "TANGENTIAL" or "GLOBAL"; empty: not given.
    std::optional<bool> bRotationAllowed;

    bool operator==(const RouteEdge&) const = default;
};

/// A way: edge i leads from node i to node i + 1.
struct Route
{
    std::vector<RouteNode> nodes;
    std::vector<RouteEdge> edges;
    double travelSeconds = 0;

    bool operator==(const Route&) const = default;
};

/// Drive along the route, whose first node is where the robot stands. It may go up to the last released node (the
/// base) and will be given more (the rest is the horizon). Answered by NodePassed for its first node as soon as the robot has
/// taken it, then for each further one, and Arrived; or by DriveRejected, at any moment.
struct Drive
{
    std::string driveID;           ///< A UUID; never used twice.
    Route route;                   ///< Two nodes or more.
    std::size_t releasedCount = 0; ///< Nodes released from the start on; 1 up to the number of nodes - 1.

    bool operator==(const Drive&) const = default;
};

/// The base of the present drive has grown. Has no answer of its own: a robot that cannot take it rejects the drive.
struct ExtendDrive
{
    std::string driveID;
    std::size_t releasedCount = 0;

    bool operator==(const ExtendDrive&) const = default;
};

/// Stop, answered by DriveCancelled (or Arrived, where it was too late).
struct CancelDrive
{
    std::string driveID;

    bool operator==(const CancelDrive&) const = default;
};

/// Do a job here. Answered by JobStarted and then JobFinished or JobFailed, or by JobUnknown where it was surely not begun
/// and may be given again, or JobUnresolved where nobody can tell. All locations are canonical and name the robot itself
/// ("LR01.CP01", never "AMR.CP01").
struct StartJob
{
    std::string planID;
    std::int32_t stepNo = 0;
    std::string jobID; ///< Where the plan gave the step no job, one that the engine made: the MCS does not know it.
    std::string action;
    std::string position; ///< The station where the robot stands.
    std::optional<std::string> from;
    std::optional<std::string> to;
    std::optional<std::string> carrierID;
    /// A UUID. What is done under it is done once: another plan may bring the same jobID, and a job that has to be sent
    /// again, because the robot never had it, has the same commandID.
    std::string commandID;
    std::string progressToken; ///< RestartEvidence::progressToken of the moment before.
    /// For robots that cannot show a UUID, such as the words of an arm's controller: random, 1 to 2^31 - 1, different from
    /// that of the robot's previous job, stored with the command. 0: unknown, commanded by an older version.
    std::int32_t jobNumber = 0;

    bool operator==(const StartJob&) const = default;
};

/// After a restart: tell what became of this job, which was commanded before and whose end nobody has heard. Answered, as
/// soon as the robot is there, by JobStarted, JobFinished or JobFailed, and else by one of JobUnknown and JobUnresolved. It
/// never begins the job.
struct RecoverJob
{
    StartJob job; ///< As it was commanded.
    /// Of the Drives and StartJobs that the robot was given before it, the latest first; not all of them.
    std::vector<std::string> earlierIDs;

    bool operator==(const RecoverJob&) const = default;
};

/// Give the job up; answered by JobFailed or, where it was too late, JobFinished.
struct CancelJob
{
    std::string jobID;

    bool operator==(const CancelJob&) const = default;
};

/// Stop as soon as possible and stay able to go on. Has no answer but the state, which shows bPaused: where it does not in time
/// (ControlOptions::pauseTimeout), the control has failed and the robot is told to resume.
struct Pause
{
    bool operator==(const Pause&) const = default;
};

/// Go on. Answered by the state likewise: bPaused is false, or the control has failed and the robot is told to pause again.
struct Resume
{
    bool operator==(const Resume&) const = default;
};

/// Charge; the state shows bCharging. Until it does the robot is told again every 10 s, and an alarm tells of it. Only where
/// the robot stands at its charging station, without a drive or a job.
struct StartCharging
{
    bool operator==(const StartCharging&) const = default;
};

/// Charge no longer; a drive may follow at once.
struct StopCharging
{
    bool operator==(const StopCharging&) const = default;
};

/// What the engine asks of a robot. One drive or one job at a time, never both.
using RobotCommand = std::variant<
    Drive,
    ExtendDrive,
    CancelDrive,
    StartJob,
    RecoverJob,
    CancelJob,
    Pause,
    Resume,
    StartCharging,
    StopCharging>;

} // namespace ACS::Planning

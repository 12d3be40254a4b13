#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsctl
{

/// The answers of the operator API `/v1`, with the names of its members. Times are texts as acsd writes them (RFC 3339, UTC).

struct LinkInfo
{
    std::string name;
    bool bUp = false;
    std::optional<std::string> reason;
    std::optional<std::string> since;
    std::optional<std::string> broker{};
};

struct OutboxInfo
{
    std::uint64_t reports = 0;
    std::optional<std::string> oldest;
};

struct RefusedReport
{
    std::string command;
    std::optional<std::string> planID;
    std::string message;
    bool bRetried = false;
};

struct RefusedReportsInfo
{
    std::uint64_t count = 0;
    std::optional<RefusedReport> last;
};

struct PlanCounts
{
    std::uint64_t active = 0;
    std::uint64_t waiting = 0;
};

/// Number of robots in each status, in the order of the answer.
struct StatusCounts
{
    std::vector<std::pair<std::string, std::uint64_t>> counts;
};

struct RobotCounts
{
    std::uint64_t total = 0;
    StatusCounts byStatus;
};

struct AlarmCounts
{
    std::uint64_t heavy = 0;
    std::uint64_t light = 0;
};

struct StatusInfo
{
    std::string version;
    std::optional<std::string> startedAt;
    double uptimeSeconds = 0;
    bool bReady = false;
    std::vector<std::string> notReadyReasons;
    std::optional<bool> bConnected; ///< As last reported to the MCS; nullopt: not yet.
    std::vector<LinkInfo> links;
    std::string tsc;
    std::optional<std::string> tscReason;
    OutboxInfo outbox;
    RefusedReportsInfo refusedReports;
    PlanCounts plans;
    RobotCounts robots;
    AlarmCounts alarms;
};

/// Why a robot cannot execute a plan that waits.
struct RobotReason
{
    std::string robotID;
    std::string reason;
};

struct WaitsInfo
{
    std::string message;
    std::optional<std::string> since;
    std::optional<std::uint64_t> queuePosition;
    std::vector<RobotReason> robots;
};

struct JobInfo
{
    std::string jobID;
    std::optional<std::string> from;
    std::optional<std::string> to;
    std::string status;
};

struct StepInfo
{
    std::int64_t stepNo = 0;
    std::string action;
    std::string position;
    std::string status;
    std::vector<std::optional<std::string>> carrierIDs;
    std::vector<JobInfo> jobs;
};

struct PlanInfo
{
    std::string planID;
    std::optional<std::string> lotID;
    std::optional<std::int64_t> priority;
    std::string status;
    std::optional<std::string> robotID;
    std::int64_t stepNo = 0;
    std::optional<std::string> jobID;
    std::optional<std::string> currentAction;
    std::optional<std::string> acceptedAt;
    std::optional<std::string> startedAt;
    std::optional<std::string> endedAt;
    std::string message;
    std::optional<WaitsInfo> waits;
    std::vector<StepInfo> steps;
};

struct RouteNode
{
    std::string nodeID;
    bool bReserved = false;
};

struct RobotError
{
    std::string type;
    std::string level;
    std::string description;
};

struct PoseInfo
{
    double x = 0;
    double y = 0;
    std::optional<double> theta;
};

struct RobotInfo
{
    std::string robotID;
    std::string type;
    std::string driver;
    std::string status;
    std::string position;
    std::optional<std::string> node;
    std::optional<std::string> nextNode;
    std::optional<PoseInfo> pose;
    std::optional<double> battery;
    std::optional<std::string> planID;
    std::optional<std::int64_t> stepNo;
    std::optional<std::string> jobID;
    std::vector<RouteNode> route;
    std::vector<std::string> reservedNodes;
    std::vector<std::optional<std::string>> carrierIDs;
    std::vector<std::string> ports;
    bool bMaintenance = false;
    std::optional<std::string> reason;
    std::optional<bool> bArmUp;
    std::optional<std::string> topic;
    std::optional<std::string> protocolVersion;
    std::optional<std::string> mode;
    std::vector<RobotError> errors;
    std::vector<std::string> warnings;
    std::optional<std::string> lastMessageAt;
};

struct AlarmInfo
{
    std::string robotID;
    std::string errorCode;
    std::string level;
    std::string message;
    std::optional<std::string> since;
    std::string title;
    std::string cause;
    std::string remedy;
    std::optional<std::string> planID;
    std::optional<std::int64_t> stepNo;
    std::optional<std::string> jobID;
};

/// A node, an edge or a station that the operator has blocked.
struct BlockInfo
{
    std::string kind;
    std::string id;
    std::optional<std::string> reason;
    std::optional<std::string> since;
};

struct QueueEntry
{
    std::uint64_t position = 0;
    std::string planID;
    std::optional<std::int64_t> priority;
    std::optional<std::string> acceptedAt;
    std::optional<WaitsInfo> waits;
};

struct PlansAnswer
{
    std::vector<PlanInfo> plans;
};

struct RobotsAnswer
{
    std::vector<RobotInfo> robots;
};

struct AlarmsAnswer
{
    std::vector<AlarmInfo> alarms;
};

struct LinksAnswer
{
    std::vector<LinkInfo> links;
};

struct QueueAnswer
{
    std::vector<QueueEntry> plans;
    OutboxInfo outbox;
};

struct NodeInfo
{
    std::string nodeID;
};

struct EdgeInfo
{
    std::string edgeID;
    std::string startNodeID;
    std::string endNodeID;
};

struct StationInfo
{
    std::string stationID;
    std::vector<std::string> nodeIDs;
};

/// The map without its shape, and the blocked places.
struct SiteAnswer
{
    std::vector<NodeInfo> nodes;
    std::vector<EdgeInfo> edges;
    std::vector<StationInfo> stations;
    std::vector<BlockInfo> blocked;
};

struct SnapshotAnswer
{
    std::uint64_t eventID = 0;
    StatusInfo status;
    std::vector<PlanInfo> plans;
    std::vector<RobotInfo> robots;
    std::vector<AlarmInfo> alarms;
};

/// A line of /v1/trace, or of a file of a trace.
struct TraceLine
{
    std::string time;
    std::optional<std::string> program; ///< Absent: acsd.
    std::string link;
    std::optional<std::string> direction;
    std::optional<std::string> robot;
    std::optional<std::string> topic;
    std::string text;
    std::optional<std::uint64_t> lost;
};

/// A line of /v1/audit.
struct AuditLine
{
    std::string time;
    std::optional<std::string> peer;
    std::optional<std::string> name;
    std::optional<std::string> role;
    std::optional<std::string> method;
    std::optional<std::string> request;
    std::optional<std::int64_t> status;
    Core::JsonText answer;
    std::optional<std::uint64_t> lost;
};

/// The data of an event `entry` of /v1/events.
struct EntryEvent
{
    std::string time;
    std::string kind;
    std::optional<std::string> robotID;
    std::optional<std::string> planID;
    std::string text;
};

/// An instant action that was requested of a robot.
struct ActionInfo
{
    std::string actionID;
    std::string actionType;
    std::string status; ///< "Waiting", "Finished"
    std::string resultDescription;
    std::optional<std::string> requestedAt;
    std::optional<std::string> endedAt; ///< Absent until its outcome is known, or known to be unknown.
};

struct ActionParameterInfo
{
    std::string key;
    std::string valueType; ///< "STRING", "NUMBER"
    bool bRequired = false;
};

/// An instant action that a robot offers.
struct ActionOfferInfo
{
    std::string actionType;
    std::string description;
    std::vector<ActionParameterInfo> parameters;
};

/// The answer of /v1/robots/ID/actions.
struct ActionsAnswer
{
    std::vector<ActionInfo> actions;
    std::vector<ActionOfferInfo> offered;
};

/// The answer to an accepted instant action.
struct ActionAcceptedAnswer
{
    std::string message;
    std::string actionID;
};

/// The answer to an accepted command.
struct MessageAnswer
{
    std::string message;
};

/// The answer to a refused request.
struct ErrorAnswer
{
    std::string error;
};

} // namespace ACS::Acsctl

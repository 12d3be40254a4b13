#pragma once

#include <acs/plan/EBlockKind.hpp>
#include <acs/plan/EControlOrigin.hpp>
#include <acs/plan/EJobResolution.hpp>
#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/Plan.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// Assigns a ReplyCommand to its command. Chosen by the caller; the engine only copies it.
using ReplyToken = std::uint64_t;

/// Submit a plan (ExecutionPlan). Answered by one ReplyCommand.
struct SubmitPlan
{
    Plan plan; ///< As received.
    ReplyToken replyToken = 0;
    /// The transactionId of the request. The same plan with the same transactionId is answered as the first time and not
    /// accepted twice, also after a restart (register D-23). Empty: a repetition is rejected as a duplicate.
    std::string transactionID = {};

    bool operator==(const SubmitPlan&) const = default;
};

/// CancelPlan, AbortPlan, PausePlan, ResumePlan. Answered by one ReplyCommand immediately and, if it is the MCS's, by one
/// ControlResultReport when the outcome is known. An operator's has the same effect and the same reports of the plan, but no
/// result report; it is refused while a control of the MCS has no result yet, and where the MCS's would fail at once.
struct ControlPlan
{
    EPlanControl control = EPlanControl::Cancel; ///< What to do with the plan.
    std::string planID;
    std::string reason; ///< May be empty.
    ReplyToken replyToken = 0;
    std::string transactionID = {}; ///< Of the request; a repetition has no result report of its own. May be empty.
    EControlOrigin origin = EControlOrigin::MCS; ///< Who is answered.

    bool operator==(const ControlPlan&) const = default;
};

/// The MCS has acknowledged the report of this number (OutboxEntry::sequence), with Success or Fail.
struct MessageAcknowledged
{
    std::uint64_t sequence = 0; ///< OutboxEntry::sequence.

    bool operator==(const MessageAcknowledged&) const = default;
};

/// Operator: pause the TSC (Pausing, then Paused), or return to Auto. Accepted without effect if the TSC is in that state
/// already. Answered by one ReplyCommand.
struct ControlTSC
{
    bool bPause = false; ///< False: return to Auto.
    ReplyToken replyToken = 0;

    bool operator==(const ControlTSC&) const = default;
};

/// Operator: resolve an unresolved job (alarm ACS-1008). Later events of the robot about this job are ignored; a Failed job is
/// cancelled at the robot. Answered by one ReplyCommand.
struct ResolveJob
{
    std::string planID;
    std::string jobID;                                ///< As in the alarm.
    EJobResolution resolution = EJobResolution::Done; ///< What the operator has found.
    ReplyToken replyToken = 0;

    bool operator==(const ResolveJob&) const = default;
};

/// Operator: take the robot out of service, or return it to service. A robot in maintenance completes its plan, is given no
/// other one and is not driven. Survives a restart. Answered by one ReplyCommand.
struct SetMaintenance
{
    std::string robotID;
    bool bOn = false; ///< False: return it to service.
    ReplyToken replyToken = 0;

    bool operator==(const SetMaintenance&) const = default;
};

/// Operator: clear these alarms. An alarm whose cause persists is set again. Answered by one ReplyCommand.
struct ClearAlarms
{
    std::string robotID;               ///< As in the alarm.
    std::string errorCode;             ///< As in the alarm.
    std::optional<std::string> planID; ///< nullopt: alarms with and without a plan.
    std::optional<std::string> jobID;  ///< nullopt: alarms with and without a job.
    ReplyToken replyToken = 0;

    bool operator==(const ClearAlarms&) const = default;
};

/// Operator: correct the record of the robot's ports. Answered by one ReplyCommand.
struct SetCarriers
{
    std::string robotID;
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port, in the order of RobotOptions::ports.
    ReplyToken replyToken = 0;

    bool operator==(const SetCarriers&) const = default;
};

/// Operator: skip a step (section 6.13). Accepted for a Pending step of a plan that a robot has, and for a step with an
/// unresolved job (alarm ACS-1008). That job is cancelled at the robot and not reported any more; the record of the robot's
/// ports is unchanged. Answered by one ReplyCommand.
struct SkipStep
{
    std::string planID;
    std::int32_t stepNo = 0;
    ReplyToken replyToken = 0;

    bool operator==(const SkipStep&) const = default;
};

/// Operator: change the priority of a plan that waits in the queue. Every priority is accepted, as in SubmitPlan. The order of
/// the queue follows at once; the time that the plan has waited counts as before. Survives a restart. Answered by one
/// ReplyCommand.
struct SetPlanPriority
{
    std::string planID;
    std::int32_t priority = 0; ///< Replaces Plan::priority.
    ReplyToken replyToken = 0;

    bool operator==(const SetPlanPriority&) const = default;
};

/// Operator: close a node, an edge or a station. No drive begins and no node is granted that needs it; a drive under way is
/// rerouted where its base ends, or waits there. Granted nodes are still driven, and a robot on a blocked node may leave it.
/// Survives a restart. Refused if there is no such node, edge or station, if it is blocked already, and beyond MAXIMUM_BLOCKS.
/// Answered by one ReplyCommand.
struct BlockPlace
{
    EBlockKind kind = EBlockKind::Node; ///< What id names.
    std::string id;                     ///< nodeID, edgeID or stationID.
    std::string reason;                 ///< For wait reasons; may be empty. At most MAXIMUM_REASON_LENGTH.
    ReplyToken replyToken = 0;

    bool operator==(const BlockPlace&) const = default;
};

/// Operator: open what BlockPlace has closed. Answered by one ReplyCommand.
struct UnblockPlace
{
    EBlockKind kind = EBlockKind::Node; ///< As in the block.
    std::string id;                     ///< As in the block.
    ReplyToken replyToken = 0;

    bool operator==(const UnblockPlace&) const = default;
};

/// Commands of the MCS and of the operator.
using PlanCommand = std::variant<
    SubmitPlan,
    ControlPlan,
    MessageAcknowledged,
    ControlTSC,
    ResolveJob,
    SetMaintenance,
    ClearAlarms,
    SetCarriers,
    SkipStep,
    SetPlanPriority,
    BlockPlace,
    UnblockPlace>;

} // namespace ACS::Planning

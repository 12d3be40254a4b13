#pragma once

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

/// Ties ReplyCommand to its command; the caller gives it and the engine does not look at it.
using ReplyToken = std::uint64_t;

/// Take this plan (ExecutionPlan). Answered by one ReplyCommand.
struct SubmitPlan
{
    Plan plan;
    ReplyToken replyToken = 0;
    /// Of the request. The same plan again with the same one is answered as the first time and not taken twice, also after
    /// a restart (register D-23); empty: every repetition is a duplicate.
    std::string transactionID = {};

    bool operator==(const SubmitPlan&) const = default;
};

/// CancelPlan, AbortPlan, PausePlan, ResumePlan. Answered by one ReplyCommand at once and by one ControlResultReport
/// when the outcome is known.
struct ControlPlan
{
    EPlanControl control = EPlanControl::Cancel;
    std::string planID;
    std::string reason; ///< May be empty.
    ReplyToken replyToken = 0;
    std::string transactionID = {}; ///< Of the request: a repetition of it has no result of its own. May be empty.

    bool operator==(const ControlPlan&) const = default;
};

/// The MCS has acknowledged the report of this number (OutboxEntry::sequence), with either result.
struct MessageAcknowledged
{
    std::uint64_t sequence = 0;

    bool operator==(const MessageAcknowledged&) const = default;
};

/// Of the operator: begin nothing any more (Pausing, then Paused), or be Auto again. Changes nothing where it is so
/// already. Answered by one ReplyCommand.
struct ControlTSC
{
    bool bPause = false;
    ReplyToken replyToken = 0;

    bool operator==(const ControlTSC&) const = default;
};

/// Of the operator, who has looked: what became of a job that is held (alarm ACS-1008). What the robot tells of it later
/// changes nothing. Answered by one ReplyCommand.
struct ResolveJob
{
    std::string planID;
    std::string jobID; ///< As the alarm names it.
    EJobResolution answer = EJobResolution::Done;
    ReplyToken replyToken = 0;

    bool operator==(const ResolveJob&) const = default;
};

/// Of the operator: the robot is taken out of service, or given back. It ends its plan first, takes no other one and is
/// driven nowhere; kept over a restart. Answered by one ReplyCommand.
struct SetMaintenance
{
    std::string robotID;
    bool bOn = false;
    ReplyToken replyToken = 0;

    bool operator==(const SetMaintenance&) const = default;
};

/// Of the operator: these alarms were seen to. One whose cause is still there is set again. Answered by one ReplyCommand.
struct ClearAlarms
{
    std::string robotID;
    std::string errorCode;
    std::optional<std::string> planID; ///< Absent: of any plan, or of none.
    std::optional<std::string> jobID;  ///< Likewise.
    ReplyToken replyToken = 0;

    bool operator==(const ClearAlarms&) const = default;
};

/// Of the operator: what is on the robot's ports, where the engine has it wrong. Answered by one ReplyCommand.
struct SetCarriers
{
    std::string robotID;
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port, in the order of RobotOptions::ports.
    ReplyToken replyToken = 0;

    bool operator==(const SetCarriers&) const = default;
};

/// Of the operator: leave this step out (section 6.13). One that is Pending in a plan that a robot has, or one whose job is
/// unresolved (alarm ACS-1008): the job has no further report, and the record of the robot's ports stays as it is. Answered
/// by one ReplyCommand.
struct SkipStep
{
    std::string planID;
    std::int32_t stepNo = 0;
    ReplyToken replyToken = 0;

    bool operator==(const SkipStep&) const = default;
};

using PlanCommand = std::variant<
    SubmitPlan,
    ControlPlan,
    MessageAcknowledged,
    ControlTSC,
    ResolveJob,
    SetMaintenance,
    ClearAlarms,
    SetCarriers,
    SkipStep>;

} // namespace ACS::Planning

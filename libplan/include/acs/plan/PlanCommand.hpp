#pragma once

#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/Plan.hpp>

#include <cstdint>
#include <string>
#include <variant>

namespace ACS::Planning
{

/// Ties ReplyCommand to its command; the caller gives it and the engine does not look at it.
using ReplyToken = std::uint64_t;

/// Take this plan (ExecutionPlan). Answered by one ReplyCommand.
struct SubmitPlan
{
    Plan plan;
    ReplyToken replyToken = 0;

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
struct ControlTsc
{
    bool bPause = false;
    ReplyToken replyToken = 0;

    bool operator==(const ControlTsc&) const = default;
};

using PlanCommand = std::variant<SubmitPlan, ControlPlan, MessageAcknowledged, ControlTsc>;

} // namespace ACS::Planning

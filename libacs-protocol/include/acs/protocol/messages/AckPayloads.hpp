#pragma once

#include <acs/protocol/messages/Errors.hpp>
#include <acs/protocol/messages/PlanQueries.hpp>

#include <string>
#include <vector>

namespace ACS::Protocol
{

/// The payload of the Ack of every command that is not named below.
struct EmptyAck
{
    bool operator==(const EmptyAck&) const = default;
};

/// Of ExecutionPlan, CancelPlan, AbortPlan, PausePlan and ResumePlan.
struct PlanAck
{
    std::string planID; ///< Left out when empty: a refusal of what had no readable id.

    bool operator==(const PlanAck&) const = default;
};

/// Of RequestAcsPlans and RequestAcsPlanHistory.
struct PlanListAck
{
    std::vector<PlanEntry> plans; ///< Empty: there is none.

    bool operator==(const PlanListAck&) const = default;
};

/// Of RequestAcsErrorList.
struct ErrorListAck
{
    std::vector<ErrorReport> errors; ///< Errors that are set; empty: none.

    bool operator==(const ErrorListAck&) const = default;
};

} // namespace ACS::Protocol

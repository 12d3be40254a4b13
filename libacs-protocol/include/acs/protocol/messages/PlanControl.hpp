#pragma once

#include <acs/core/Api.hpp>
#include <acs/protocol/EAcsCommand.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// The `result` of a result report (sections 6.5 to 6.8): the failure word differs from that of an Ack (D-1).
enum class EReportResult : std::uint8_t
{
    Success,
    Failed,
    Fail, ///< Written only, for an MCS that has the word of Acks here too (D-1); read as Failed.
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EReportResult result);

/// MCS to ACS: what to do with a plan. Acknowledged with PlanAck at once; the outcome follows as a result report.
template <EAcsCommand COMMAND>
struct PlanControl
{
    std::string planID; ///< Of a plan that the ACS has accepted.
    std::string reason; ///< Left out when empty; ResumePlan has none in the document.

    bool operator==(const PlanControl&) const = default;
};

using CancelPlan = PlanControl<EAcsCommand::CancelPlan>; ///< Section 6.5.
using AbortPlan = PlanControl<EAcsCommand::AbortPlan>;   ///< Section 6.6.
using PausePlan = PlanControl<EAcsCommand::PausePlan>;   ///< Section 6.7.
using ResumePlan = PlanControl<EAcsCommand::ResumePlan>; ///< Section 6.8.

/// ACS to MCS: what became of the request (sections 6.5.A to 6.8.A).
template <EAcsCommand COMMAND>
struct ResultReport
{
    std::string planID;
    EReportResult result = EReportResult::Success;
    std::string message;

    bool operator==(const ResultReport&) const = default;
};

using CancelResultReport = ResultReport<EAcsCommand::CancelResultReport>; ///< Section 6.5.A.
using AbortResultReport = ResultReport<EAcsCommand::AbortResultReport>;   ///< Section 6.6.A.
using PauseResultReport = ResultReport<EAcsCommand::PauseResultReport>;   ///< Section 6.7.A.
using ResumeResultReport = ResultReport<EAcsCommand::ResumeResultReport>; ///< Section 6.8.A.

} // namespace ACS::Protocol

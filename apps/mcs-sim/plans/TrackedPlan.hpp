#pragma once

#include "plans/PlannedPlan.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/messages/Reports.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// State of the transfer of the plan to the ACS.
enum class EDelivery : std::uint8_t
{
    Blocked,  ///< Another plan must end first.
    Waiting,  ///< To be sent, for the first time or again.
    Sent,     ///< No Ack yet.
    Accepted, ///< Ack Success: never sent again.
    Refused,  ///< Ack Fail.
};

/// What came of a plan.
enum class EOutcome : std::uint8_t
{
    Open,
    Completed,
    Failed,
    Cancelled,
    Aborted,
    Refused,
};

inline constexpr std::size_t OUTCOME_COUNT = 6;

struct TrackedJob
{
    std::string jobID;
    Protocol::EJobStatus status = Protocol::EJobStatus::Pending;
    bool bReported = false;
};

struct TrackedStep
{
    std::int32_t stepNo = 0;
    std::string action;
    std::string position;
    Protocol::EStepStatus status = Protocol::EStepStatus::Pending;
    bool bReported = false;
    std::vector<TrackedJob> jobs;
};

/// A plan according to its reports.
struct TrackedPlan
{
    PlannedPlan planned;
    EDelivery delivery = EDelivery::Waiting;
    std::size_t sends = 0;
    Core::SteadyTime lastSent{};
    Protocol::EPlanStatus status = Protocol::EPlanStatus::Pending;
    bool bReported = false;
    bool bAckLost = false; ///< Or perhaps lost with the link: its absence is no fault of the ACS.
    /// The result report that stated the success of a cancel, an abort or a resume which no PlanReport has confirmed yet.
    std::optional<Protocol::EAcsCommand> unconfirmed;
    std::string robotID;            ///< Empty until a report names one.
    std::string reason;             ///< Of the refusal or the failure, as the ACS gave it.
    std::vector<TrackedStep> steps; ///< By ascending stepNo.
};

[[nodiscard]] std::string_view GetText(EOutcome outcome);
[[nodiscard]] EOutcome GetOutcome(const TrackedPlan& plan);
/// Completed or Skipped: the next step may begin.
[[nodiscard]] bool IsDone(const TrackedStep& step) noexcept;
/// The index of the step that is being worked on, or comes next; of the last one where all are done.
[[nodiscard]] std::size_t GetCurrentStep(const TrackedPlan& plan) noexcept;
/// The same for the jobs of a step; 0 where it has none.
[[nodiscard]] std::size_t GetCurrentJob(const TrackedStep& step) noexcept;
/// From 0 to 1: arrivals and jobs count alike.
[[nodiscard]] double GetProgress(const TrackedPlan& plan) noexcept;

} // namespace ACS::McsSim

#pragma once

#include "plans/TrackedPlan.hpp"
#include <acs/protocol/messages/RobotStatus.hpp>

#include <optional>
#include <string>

namespace ACS::McsSim
{

/// Stopped, or a status that takes precedence over it: with a fault, not connected or not ready.
[[nodiscard]] bool IsStandstill(Protocol::ERobotStatus status) noexcept;

/// What is wrong with a report that would change the plan, step or job to this status; nullopt where nothing is.
/// Checks the transitions of sections 6.12 to 6.14 and their causal order: job, then its step, then the plan.
[[nodiscard]] std::optional<std::string> FindPlanViolationOrNull(const TrackedPlan& plan, Protocol::EPlanStatus status);
/// What is wrong with the Success of a control, if its PlanReport cannot follow any more.
[[nodiscard]] std::optional<std::string> FindSuccessViolationOrNull(
    const TrackedPlan& plan,
    Protocol::EAcsCommand result);
/// Whether the PlanReports so far confirm the Success of a control.
[[nodiscard]] bool IsConfirmed(const TrackedPlan& plan, Protocol::EAcsCommand result);
[[nodiscard]] std::optional<std::string> FindStepViolationOrNull(
    const TrackedPlan& plan,
    const TrackedStep& step,
    Protocol::EStepStatus status);
/// The report assigns the begun plan to another robot, which is allowed before its first job.
[[nodiscard]] bool IsTakenOver(const TrackedPlan& plan, const TrackedStep& step, const Protocol::StepReport& report);
[[nodiscard]] std::optional<std::string> FindJobViolationOrNull(
    const TrackedPlan& plan,
    const TrackedStep& step,
    const TrackedJob& job,
    Protocol::EJobStatus status);

} // namespace ACS::McsSim

#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/EControlOrigin.hpp>
#include <acs/plan/EJobState.hpp>
#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/EStepState.hpp>
#include <acs/plan/Plan.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// The states of a step and of its jobs.
struct StepProgress
{
    EStepState state = EStepState::Pending; ///< The current one.
    std::vector<EJobState> jobs;            ///< One per job of the step.

    bool operator==(const StepProgress&) const = default;
};

/// The part of a plan record that changes during execution.
struct PlanProgress
{
    EPlanState state = EPlanState::Pending;  ///< The current one.
    std::string robotID;                     ///< Empty until the plan is assigned to a robot.
    std::string message;                     ///< Message of the last PlanReport.
    std::optional<Core::WallTime> startedAt; ///< nullopt: not started.
    std::optional<Core::WallTime> endedAt;   ///< nullopt: not ended.
    std::vector<StepProgress> steps;         ///< One per step of the plan, in ascending stepNo.
    bool bArrived = false;                   ///< The last node before the position of the first step was reached.
    std::optional<EPlanControl> control;     ///< The acknowledged control whose outcome is not known.
    std::size_t controlCount = 0; ///< Number of the MCS's requests for that control; each gets a result report.
    /// Who began that control or, if there is none, the last one.
    EControlOrigin controlOrigin = EControlOrigin::MCS;
    std::vector<std::string> requestIDs; ///< The latest controls, each with its transactionID ("Pause 4711").
    /// Age of the queue when the plan was accepted, and when this was stored last: the time that the engine has run, restarts
    /// included. Setting the wall clock does not change it.
    std::chrono::milliseconds queuedAt{0};
    std::chrono::milliseconds storedAt{0}; ///< See queuedAt.
    std::optional<std::int32_t>
        priority; ///< As an operator has changed it (SetPlanPriority); nullopt: that of the plan.

    bool operator==(const PlanProgress&) const = default;
};

/// An accepted plan, in memory and in the store.
struct PlanRecord
{
    std::uint64_t sequence = 0; ///< Order of acceptance, from 1.
    Core::WallTime acceptedAt;  ///< Time of the submission.
    Plan plan;                  ///< With its steps in ascending stepNo.
    PlanProgress progress;      ///< The current one.
    std::string transactionID;  ///< Of the request that submitted it; may be empty.

    /// The one by which it is queued; nullopt: EngineOptions::defaultPriority.
    [[nodiscard]] std::optional<std::int32_t> GetPriorityOrNull() const
    {
        return progress.priority.has_value() ? progress.priority : plan.priority;
    }

    bool operator==(const PlanRecord&) const = default;
};

/// One entry of RequestAcsPlans and RequestAcsPlanHistory (sections 6.10 and 6.11 of MCS-ACS).
struct PlanSummary
{
    std::string planID;
    std::optional<std::string> robotID;
    EPlanState state = EPlanState::Pending;
    std::int32_t stepNo = 0; ///< The current step; 0 for a completed plan.
    std::optional<std::string> jobID;
    std::optional<std::string> currentAction;
    Core::WallTime startTime; ///< Time of acceptance if the plan has not started.
    std::optional<Core::WallTime> endTime;

    bool operator==(const PlanSummary&) const = default;
};

} // namespace ACS::Planning

#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/EJobState.hpp>
#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/EStepState.hpp>
#include <acs/plan/Plan.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Where a step stands.
struct StepProgress
{
    EStepState state = EStepState::Pending;
    std::vector<EJobState> jobs; ///< As many as the step has.

    bool operator==(const StepProgress&) const = default;
};

/// The states of a plan: what changes while it lives.
struct PlanProgress
{
    EPlanState state = EPlanState::Pending;
    std::string robotID; ///< Empty until a robot has it.
    std::string message; ///< Of the last PlanReport.
    std::optional<Core::WallTime> startedAt;
    std::optional<Core::WallTime> endedAt;
    std::vector<StepProgress> steps;     ///< As many as the plan has, in ascending stepNo.
    bool bArrived = false;               ///< The last node before the place of its first step was reached.
    std::optional<EPlanControl> control; ///< Acknowledged, its outcome not known.
    std::size_t controlCount = 0;        ///< How often it was asked for: each is owed a result.
    std::vector<std::string> requestIDs; ///< Its controls ("Pause 4711": the transactionID), the latest ones.

    bool operator==(const PlanProgress&) const = default;
};

/// An accepted plan, as it is kept and stored.
struct PlanRecord
{
    std::uint64_t sequence = 0; ///< Order of acceptance, from 1.
    Core::WallTime acceptedAt;
    Plan plan; ///< Its steps in ascending stepNo.
    PlanProgress progress;
    std::string transactionID; ///< Of the request that brought it; may be empty.

    bool operator==(const PlanRecord&) const = default;
};

/// One entry of RequestAcsPlans and RequestAcsPlanHistory (section 4.3 of MCS-ACS).
struct PlanSummary
{
    std::string planID;
    std::optional<std::string> robotID;
    EPlanState state = EPlanState::Pending;
    std::int32_t stepNo = 0; ///< 0 of a completed plan.
    std::optional<std::string> jobID;
    std::optional<std::string> currentAction;
    Core::WallTime startTime; ///< Of a plan that has not started: when it was accepted.
    std::optional<Core::WallTime> endTime;

    bool operator==(const PlanSummary&) const = default;
};

} // namespace ACS::Planning

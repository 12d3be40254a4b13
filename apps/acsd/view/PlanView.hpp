#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// A robot that could execute a waiting plan, and why it does not.
struct RobotReasonView
{
    std::string robotID;
    std::string reason;

    bool operator==(const RobotReasonView&) const = default;
};

/// Why a plan makes no progress.
struct WaitView
{
    std::string message;
    Core::WallTime since; ///< The plan has made no progress since then; at the earliest the start of acsd.
    std::optional<std::size_t> queuePosition; ///< From 1; nullopt if a robot has the plan.
    std::vector<RobotReasonView> robots;

    bool operator==(const WaitView&) const = default;
};

struct JobView
{
    std::string jobID;
    std::optional<std::string> from;
    std::optional<std::string> to;
    std::string status;

    bool operator==(const JobView&) const = default;
};

struct StepView
{
    std::int32_t stepNo = 0;
    std::string action;
    std::string position;
    std::string status;
    std::vector<std::string> carrierIDs; ///< Of the view of one plan only, as the jobs.
    std::vector<JobView> jobs;

    bool operator==(const StepView&) const = default;
};

/// A plan, as the operator sees it.
struct PlanView
{
    std::string planID;
    std::string lotID;
    std::optional<std::int32_t> priority;
    std::string status;
    std::optional<std::string> robotID;
    std::int32_t stepNo = 0; ///< The current step; 0 for a completed plan.
    std::optional<std::string> jobID;
    std::optional<std::string> currentAction;
    Core::WallTime acceptedAt;
    std::optional<Core::WallTime> startedAt;
    std::optional<Core::WallTime> endedAt;
    std::string message;           ///< Of its last report; may be empty.
    std::optional<WaitView> waits; ///< nullopt while the plan makes progress.
    std::vector<StepView> steps;

    bool operator==(const PlanView&) const = default;
};

} // namespace ACS::Acsd

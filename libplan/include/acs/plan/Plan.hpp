#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Maximum length of a planID, jobID, lotID and carrierID in bytes.
inline constexpr std::size_t MAXIMUM_ID_LENGTH = 128;

/// One operation of a robot at the position of its step (sections 6.3 and 6.4 of MCS-ACS).
struct Job
{
    std::string jobID;               ///< Unique in the plan; opaque.
    std::optional<std::string> from; ///< A location as received; absent or empty if the action has none.
    std::optional<std::string> to;   ///< As from.

    bool operator==(const Job&) const = default;
};

/// The drive to a position and the jobs there.
struct Step
{
    std::int32_t stepNo = 0; ///< From 1, unique in the plan; steps run in ascending order.
    std::string action;      ///< A name in EngineOptions::actions ("CassetteLoad").
    std::string position;    ///< Where the robot works, as received: a station or a place inside one.
    /// Of a load or an unload: entry i belongs to job i. May be shorter than jobs.
    std::vector<std::string> carrierIDs;
    std::vector<Job> jobs; ///< Executed in this order; may be empty (ActionRule::bJobsRequired).

    bool operator==(const Step&) const = default;
};

/// An ExecutionPlan (sections 6.3 and 6.4 of MCS-ACS) as received. Unchecked: PlanEngine validates it on submission.
struct Plan
{
    std::string planID; ///< Unique; opaque.
    std::string lotID;  ///< May be empty.
    std::optional<std::int32_t> priority;
    std::vector<Step> steps;

    bool operator==(const Plan&) const = default;
};

} // namespace ACS::Planning

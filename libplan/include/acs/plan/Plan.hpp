#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// The longest planID, jobID, lotID and carrierID, in bytes.
inline constexpr std::size_t MAXIMUM_ID_LENGTH = 128;

/// One operation that a robot does after its arrival, without moving (section 4.1 of MCS-ACS).
struct Job
{
    std::string jobID;               ///< Unique in the plan; opaque.
    std::optional<std::string> from; ///< A location as the MCS wrote it; absent or empty where the action has none.
    std::optional<std::string> to;   ///< Likewise.

    bool operator==(const Job&) const = default;
};

/// The travel to a place and the jobs there.
struct Step
{
    std::int32_t stepNo = 0; ///< From 1, unique in the plan; steps run in ascending order.
    std::string action;      ///< A name in EngineOptions::actions ("CassetteLoad").
    std::string position;    ///< Where the robot must stand, as the MCS wrote it: a station or a place inside one.
    std::vector<std::string>
        carrierIDs; ///< Of a load or an unload: entry i belongs to job i. May be shorter than jobs.
    std::vector<Job> jobs;

    bool operator==(const Step&) const = default;
};

/// An ExecutionPlan (section 6.3, 6.4 of MCS-ACS) as it came: texts from outside, checked by PlanEngine on submission.
struct Plan
{
    std::string planID; ///< Unique; opaque.
    std::string lotID;  ///< May be empty.
    std::optional<std::int32_t> priority;
    std::vector<Step> steps;

    bool operator==(const Plan&) const = default;
};

} // namespace ACS::Planning

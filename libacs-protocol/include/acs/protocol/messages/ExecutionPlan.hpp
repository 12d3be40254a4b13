#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Protocol
{

/// One robot operation of a step (sections 6.3, 6.4). Locations are kept in the sender's spelling: Core::Location parses.
struct PlanJob
{
    std::string jobID; ///< Opaque, 1 to 512 bytes.
    std::string from;  ///< Empty where absent, null or empty: CloseSetCover, OpenSetCover and Start have none.
    std::string to;    ///< As from.

    bool operator==(const PlanJob&) const = default;
};

/// A drive to a position and what is done there.
struct PlanStep
{
    std::int32_t stepNo = 0; ///< From 1; gaps and any order are allowed, the codec does not look for repeats.
    std::string action;      ///< For example CassetteLoad; which actions exist is the site's data.
    std::string position;    ///< Where the robot executes the step.
    std::vector<std::string> carrierIDs; ///< Of load steps entry i belongs to job i; empty for MemoryPickAndPlace.
    std::vector<PlanJob> jobs;           ///< May be empty for actions on a set.

    bool operator==(const PlanStep&) const = default;
};

/// MCS to ACS: the work for one lot. Acknowledged with PlanAck.
struct ExecutionPlan
{
    std::string planID;                   ///< Opaque, 1 to 512 bytes.
    std::string lotID;                    ///< Empty where the sender left it out.
    std::optional<std::int32_t> priority; ///< Which direction is more urgent is the site's decision; 0 may mean none.
    std::vector<PlanStep> steps;          ///< At least one; executed by ascending stepNo.

    bool operator==(const ExecutionPlan&) const = default;
};

} // namespace ACS::Protocol

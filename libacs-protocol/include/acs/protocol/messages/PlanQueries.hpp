#pragma once

#include <acs/core/Timestamp.hpp>
#include <acs/protocol/messages/Reports.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Protocol
{

/// MCS to ACS: which plans are active (section 6.10)? Acknowledged with PlanListAck.
struct RequestAcsPlans
{
    bool operator==(const RequestAcsPlans&) const = default;
};

/// MCS to ACS: what became of these plans (section 6.11)? Acknowledged with PlanListAck.
struct RequestAcsPlanHistory
{
    std::vector<std::string> planIDs;

    bool operator==(const RequestAcsPlanHistory&) const = default;
};

/// One plan in an answer (sections 6.10, 6.11). Missing values are written as null.
struct PlanEntry
{
    std::string planID;
    std::optional<std::string> robotID; ///< Null: no robot yet.
    EPlanStatus status = EPlanStatus::Pending;
    std::int32_t stepNo = 0;                  ///< 0: completed.
    std::optional<std::string> jobID;         ///< Null: completed, or a step without jobs.
    std::optional<std::string> currentAction; ///< Null: completed.
    std::optional<Core::Timestamp> startTime;
    std::optional<Core::Timestamp> endTime; ///< Null: not ended.

    bool operator==(const PlanEntry&) const = default;
};

} // namespace ACS::Protocol

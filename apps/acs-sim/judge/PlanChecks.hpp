#pragma once

#include "judge/ERule.hpp"
#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <string>
#include <vector>

namespace ACS::AcsSim
{

/// A rule that a plan violates, and how.
struct PlanFinding
{
    ERule rule = ERule::PlanPayload;
    std::string text;

    bool operator==(const PlanFinding&) const = default;
};

/// What is wrong with the contents of a plan that the codec has decoded (sections 3.1, 6.3 and 6.4). Pure.
[[nodiscard]] std::vector<PlanFinding> CheckPlan(const Protocol::ExecutionPlan& plan);

} // namespace ACS::AcsSim

#pragma once

#include <acs/plan/PlanRecord.hpp>

#include <cstddef>

namespace ACS::Planning
{

/// The maximum number of reports that the state still allows, except those that controls cause. A plan that waits is reported as
/// Pending, InProgress and in its final state.
[[nodiscard]] std::size_t CountReportsAhead(EPlanState state);
[[nodiscard]] std::size_t CountReportsAhead(EStepState state);
[[nodiscard]] std::size_t CountReportsAhead(EJobState state);
/// With its steps and jobs.
[[nodiscard]] std::size_t CountReportsAhead(const PlanProgress& progress);
/// Of a plan that is not accepted yet.
[[nodiscard]] std::size_t CountReportsAhead(const Plan& plan);

} // namespace ACS::Planning

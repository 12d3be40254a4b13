#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/PlanRecord.hpp>

namespace ACS::Planning
{

/// The fields of a plan in section 6.10. The record must have a step.
[[nodiscard]] ACS_API PlanSummary MakeSummary(const PlanRecord& record);

} // namespace ACS::Planning

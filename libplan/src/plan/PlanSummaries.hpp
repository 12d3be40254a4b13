#pragma once

#include <acs/plan/PlanRecord.hpp>

namespace ACS::Planning
{

/// The fields of a plan in section 4.3.
[[nodiscard]] PlanSummary MakeSummary(const PlanRecord& record);

} // namespace ACS::Planning

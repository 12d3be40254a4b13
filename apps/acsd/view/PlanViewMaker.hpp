#pragma once

#include "view/PlanView.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/WaitReason.hpp>

#include <cstdint>

namespace ACS::Acsd
{

enum class EPlanDetail : std::uint8_t
{
    Steps, ///< Without their jobs and carriers: of a list.
    Jobs
};

/// The view of a plan from its record. PlanView::waits is left to the caller.
[[nodiscard]] PlanView MakePlanView(const Planning::PlanRecord& record, EPlanDetail detail);

[[nodiscard]] WaitView MakeWaitView(const Planning::WaitReason& reason, Core::WallTime since);

} // namespace ACS::Acsd

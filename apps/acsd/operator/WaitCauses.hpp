#pragma once

#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <map>
#include <string_view>

namespace ACS::Acsd
{

/// The number of unfinished plans that make no progress, by cause. Each cause is listed, also with 0.
/// "queue": no suitable robot is free. "paused": by PausePlan. "tsc": the TSC is not Auto. "store": the store is failing.
/// "route": its robot waits for other robots. "job": the outcome of a job is unknown. "robot": its robot cannot continue, for
/// example because it is disconnected, stalled or has a heavy alarm.
[[nodiscard]] std::map<std::string_view, std::size_t> CountWaitCauses(
    const Planning::PlanEngine& engine,
    bool bStoreFailing);

} // namespace ACS::Acsd

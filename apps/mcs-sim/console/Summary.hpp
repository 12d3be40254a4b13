#pragma once

#include "console/StyledLine.hpp"
#include "floor/FloorChecker.hpp"
#include "plans/PlanTracker.hpp"
#include "wire/NoteJudge.hpp"
#include "wire/TimestampJudge.hpp"
#include <acs/protocol/SessionStatistics.hpp>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// The closing table: what this program received and acknowledged, not what the ACS believes.
[[nodiscard]] StyledLines MakeSummary(
    const PlanTracker& tracker,
    const Protocol::SessionStatistics& statistics,
    const NoteCounts& notes,
    const TimestampCounts& timestamps,
    std::uint64_t missingMembers,
    std::chrono::milliseconds duration);

/// A line per plan with its current state; a line that states so if there are none.
[[nodiscard]] std::vector<std::string> DescribePlans(const PlanTracker& tracker);

/// Whether a plan was refused because of its planId (section 6.4: "Duplicated Plan").
[[nodiscard]] bool WasDuplicateRefused(const PlanTracker& tracker);

/// The line before the last one, where there is a world: "3 carriers delivered, 0 misplaced".
[[nodiscard]] std::string MakeDeliveryLine(const DeliveryCount& count);

/// The very last line: "2 plans completed, 0 failed".
[[nodiscard]] std::string MakeLastLine(const PlanTracker& tracker);

} // namespace ACS::McsSim

#pragma once

#include "plans/PlannedPlan.hpp"
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// Reads what a plan file holds: the payload of an ExecutionPlan, or the whole message. A payload has no transactionID.
[[nodiscard]] Core::Result<PlannedPlan> ParsePlanFile(std::string_view text);

/// The same from the disk. The error is one sentence that names the file.
[[nodiscard]] tl::expected<PlannedPlan, std::string> ReadPlanFile(const std::string& path);

} // namespace ACS::McsSim

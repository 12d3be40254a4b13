#pragma once

#include "commands/CommandError.hpp"
#include "options/AcsctlOptions.hpp"
#include "view/ViewContext.hpp"

#include <string>

namespace ACS::Acsctl
{

/// `trace --file`: merges the files, and returns the newest lines that match as `trace` shows those of acsd.
[[nodiscard]] Outcome<std::string> RunTraceFiles(const AcsctlOptions& options, const ViewContext& context);

} // namespace ACS::Acsctl

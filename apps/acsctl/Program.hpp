#pragma once

#include "config/Connection.hpp"
#include "options/AcsctlOptions.hpp"

namespace ACS::Acsctl
{

[[nodiscard]] Environment ReadEnvironment();

/// Executes the command; returns its exit code.
[[nodiscard]] int Run(const AcsctlOptions& options, const Environment& environment);

} // namespace ACS::Acsctl

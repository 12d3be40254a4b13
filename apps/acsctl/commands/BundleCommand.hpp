#pragma once

#include "commands/Answers.hpp"
#include "commands/CommandError.hpp"
#include "commands/Session.hpp"
#include "options/AcsctlOptions.hpp"

#include <string>

namespace ACS::Acsctl
{

/// Collects a support bundle and writes it to a new file; returns what it prints.
[[nodiscard]] Outcome<Shown> RunBundle(Session& session, const AcsctlOptions& options);

} // namespace ACS::Acsctl

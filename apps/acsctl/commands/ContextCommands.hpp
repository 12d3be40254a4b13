#pragma once

#include "commands/CommandError.hpp"
#include "config/Connection.hpp"
#include "config/ContextFile.hpp"
#include "options/AcsctlOptions.hpp"
#include "view/TextTable.hpp"

#include <string>

namespace ACS::Acsctl
{

/// Executes a command of `context`; returns what it prints.
[[nodiscard]] Outcome<std::string> RunContextCommand(
    const AcsctlOptions& options,
    const Environment& environment,
    const Screen& screen);

/// The contexts without their tokens, as a table or as JSON.
[[nodiscard]] std::string ShowContexts(const Contexts& contexts, bool bJSON, const Screen& screen);

/// Changes the context as the options state; an error is a sentence.
[[nodiscard]] tl::expected<void, std::string> SetContext(
    const AcsctlOptions& options,
    const std::string& tokenOfInput,
    Contexts& contexts);

} // namespace ACS::Acsctl

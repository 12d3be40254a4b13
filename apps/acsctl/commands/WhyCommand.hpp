#pragma once

#include "commands/Answers.hpp"
#include "commands/CommandError.hpp"
#include "http/IApi.hpp"
#include "options/AcsctlOptions.hpp"
#include "view/ViewContext.hpp"

namespace ACS::Acsctl
{

/// Reads what `why` needs and explains it.
[[nodiscard]] Outcome<Shown> RunWhy(IApi& api, const AcsctlOptions& options, const ViewContext& context);

} // namespace ACS::Acsctl

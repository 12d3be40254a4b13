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

/// Sends a GET and returns the body of an answer with status 2xx.
[[nodiscard]] Outcome<std::string> Get(IApi& api, const std::string& target);

} // namespace ACS::Acsctl

#pragma once

#include "http/ApiRequest.hpp"
#include "options/AcsctlOptions.hpp"

#include <optional>
#include <string>

namespace ACS::Acsctl
{

/// The target of the GET of a command that reads ("/v1/plans?limit=10").
[[nodiscard]] std::string MakeReadTarget(const AcsctlOptions& options);

/// The POST of a command that changes something, without its key; nullopt for a command that reads.
[[nodiscard]] std::optional<ApiRequest> MakeChangeOrNull(const AcsctlOptions& options);

/// What the operator is asked before a command that ends or changes work, or lets robots move; nullopt for others.
[[nodiscard]] std::optional<std::string> MakeQuestionOrNull(const AcsctlOptions& options);

} // namespace ACS::Acsctl

#pragma once

#include "plans/PlannedPlan.hpp"
#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace ACS::McsSim
{

/// A message that an expectation has found.
struct FoundMessage
{
    std::string transactionID;
    std::string timestamp; ///< As it was on the wire.
};

/// The envelope of a message on the wire; empty texts where there is none.
[[nodiscard]] FoundMessage ReadFoundMessage(std::string_view text);

/// The plans and messages of a scenario by the names that it gave them.
using ScenarioNames = std::map<std::string, std::variant<PlannedPlan, FoundMessage>, std::less<>>;

/// Whether a step may give this name: letters, digits, '_' and '-'.
[[nodiscard]] bool IsScenarioName(std::string_view text);

/// The value of "A" (the planId), "A.transactionId", "A.2.1" (the jobId of the first job of step 2) or "A.2.carrier.1", or
/// of "S.transactionId" or "S.timestamp" of a message; nullopt for other names.
[[nodiscard]] std::optional<std::string> ReadPlaceholderOrNull(const ScenarioNames& names, std::string_view name);

/// The first "{name}" in any text of the value that looks like a placeholder, and stands for nothing; its path begins
/// with the given one. What looks like one consists of letters, digits, '_', '-' and '.'.
[[nodiscard]] std::optional<Core::Error> FindBadPlaceholderOrNullRecursive(
    const Json::Value& value,
    const std::string& path,
    const ScenarioNames& names);

} // namespace ACS::McsSim

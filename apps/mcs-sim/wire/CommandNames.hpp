#pragma once

#include <acs/protocol/EAcsCommand.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// Exactly as spelled on the wire.
[[nodiscard]] std::optional<Protocol::EAcsCommand> FindCommandOrNull(std::string_view name);

/// "ExecutionPlan, CancelPlan": the names of all commands that match the predicate.
[[nodiscard]] std::string ListCommands(bool (*isListed)(Protocol::EAcsCommand));

[[nodiscard]] bool IsSentByACS(Protocol::EAcsCommand command);
[[nodiscard]] bool IsAckedByMCS(Protocol::EAcsCommand command);

/// What an ACS may send: its own commands, the Acks of the MCS's, and a name in which '*' makes it one of these.
[[nodiscard]] bool CanComeFromACS(std::string_view name);

} // namespace ACS::McsSim

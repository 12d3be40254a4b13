#pragma once

#include <acs/plan/PlanCommand.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Converts a request of the MCS to a command of the engine, to keep wire types and domain types separate. nullopt for
/// requests that are not commands of the engine (queries).
[[nodiscard]] std::optional<Planning::PlanCommand> MakePlanCommandOrNull(
    const Protocol::AcsPayload& payload,
    const std::string& transactionID,
    Planning::ReplyToken replyToken);

} // namespace ACS::Acsd

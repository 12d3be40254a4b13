#pragma once

#include <acs/plan/PlanCommand.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <optional>
#include <string>

namespace ACS::Acsd
{

/// From what the MCS asks to what the engine understands: wire types and domain types stay apart. nullopt for requests
/// that are no command of the engine (queries).
[[nodiscard]] std::optional<Planning::PlanCommand> MakePlanCommandOrNull(
    const Protocol::AcsPayload& payload,
    const std::string& transactionID,
    Planning::ReplyToken replyToken);

} // namespace ACS::Acsd

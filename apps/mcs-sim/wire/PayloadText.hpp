#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsMessage.hpp>

namespace ACS::McsSim
{

/// Reads the payload of a request of this command.
[[nodiscard]] Core::Result<Protocol::AcsPayload> ParsePayload(
    Protocol::EAcsCommand command,
    const Core::JsonText& payload);

} // namespace ACS::McsSim

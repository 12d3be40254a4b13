#pragma once

#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::Sim
{

/// One line of the journal, without its end: {"event":"CarrierMoved","robot":"LR01",…}.
[[nodiscard]] std::string EncodeWorldEvent(const WorldEvent& event);

/// The error has the JSON path.
[[nodiscard]] Core::Result<WorldEvent> DecodeWorldEvent(std::string_view line);

} // namespace ACS::Sim

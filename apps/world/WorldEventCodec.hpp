#pragma once

#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::Sim
{

/// A line of the journal without its line end: {"event":"CarrierMoved","robot":"LR01",…}.
[[nodiscard]] std::string EncodeWorldEvent(const WorldEvent& event);

/// The path of an error is the JSON path.
[[nodiscard]] Core::Result<WorldEvent> DecodeWorldEvent(std::string_view line);

} // namespace ACS::Sim

#pragma once

#include "common/config/ConfigSection.hpp"
#include <acs/plan/EngineOptions.hpp>

namespace ACS::Acsd
{

/// Reads the tables of queue, traffic and controls: everything of the engine but robots, actions and places.
void ReadEngineConfig(const Apps::ConfigSection& root, Planning::EngineOptions& engine);

} // namespace ACS::Acsd

#pragma once

#include "common/config/ConfigSection.hpp"
#include <acs/plan/EngineOptions.hpp>

namespace ACS::Acsd
{

/// Reads the engine's tables of queue, traffic and controls. Robots, actions and places are read elsewhere.
void ReadEngineConfig(const Apps::ConfigSection& root, Planning::EngineOptions& engine);

} // namespace ACS::Acsd

#pragma once

#include "world/IWorld.hpp"
#include <acs/core/Logger.hpp>

#include <string>

namespace ACS::VdaSim
{

/// Polls the world for what others have changed, and logs when it cannot be read any more, and when it can be read again.
class WorldWatch
{
    Sim::IWorld* _world;
    Core::Logger _logger;
    std::string _failure; ///< As it was logged; empty: the world can be read.

public:
    /// The world outlives it.
    WorldWatch(Sim::IWorld& world, Core::Logger logger);

    /// Since the last call.
    [[nodiscard]] bool HasChanged();
};

} // namespace ACS::VdaSim

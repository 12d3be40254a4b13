#pragma once

#include "world/IWorld.hpp"
#include <acs/core/Logger.hpp>

#include <string>

namespace ACS::VdaSim
{

/// Polls the world for changes, of all programs, and logs when it becomes unreadable and readable again.
class WorldWatch
{
    Sim::IWorld* _world;
    Core::Logger _logger;
    std::string _failure; ///< As it was logged; empty: the world is readable.

public:
    /// The world outlives it.
    WorldWatch(Sim::IWorld& world, Core::Logger logger);

    /// Whether the world has changed since the last call.
    [[nodiscard]] bool HasChanged();
};

} // namespace ACS::VdaSim

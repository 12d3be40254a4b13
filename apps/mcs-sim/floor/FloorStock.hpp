#pragma once

#include "floor/FloorPlan.hpp"
#include "world/IWorld.hpp"
#include <acs/core/Result.hpp>

#include <string>
#include <vector>

namespace ACS::McsSim
{

/// Makes the floor ready for a plan by hand: its carriers and memories are where it finds them first, the places to which it
/// brings some are empty. A carrier on a robot stays there, because the ACS has it on record; covers stay as they are.
/// A line for people per thing that could not be done. Fails where the world itself cannot be read or written.
[[nodiscard]] Core::Result<void> Restock(const FloorPlan& plan, Sim::IWorld& world, std::vector<std::string>& lines);

} // namespace ACS::McsSim

#pragma once

#include <cstddef>
#include <string>

/// A floor of cells, one for each robot: a ring of lanes with two ports, a lane to each neighbour. Whoever works in his own
/// cell meets nobody, however ways are reserved; yet every cell can be reached from every other, so that a search has the
/// whole floor before it. Cells count from 1.
namespace ACS::Load::CellSite
{

inline constexpr const char* VEHICLE_TYPE = "lr-base";

/// As LIF, for acsd and vda-sim.
[[nodiscard]] std::string WriteLIF(std::size_t cells);

/// The port where a carrier is loaded, and that where it is unloaded.
[[nodiscard]] std::string GetSource(std::size_t cell);
[[nodiscard]] std::string GetTarget(std::size_t cell);

/// Where the cell's robot stands at first.
[[nodiscard]] std::string GetStartNode(std::size_t cell);

} // namespace ACS::Load::CellSite

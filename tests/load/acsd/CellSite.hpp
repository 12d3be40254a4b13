#pragma once

#include <cstddef>
#include <string>

/// A floor of cells, one for each robot: a ring of lanes with two ports, a lane to each neighbour. A robot that works in its
/// own cell never meets another one, whatever the reservations. Every cell is reachable from every other, so that a route
/// search covers the whole floor. Cells are numbered from 1.
namespace ACS::Load::CellSite
{

inline constexpr const char* VEHICLE_TYPE = "lr-base";

/// The LIF file for acsd and vda-sim.
[[nodiscard]] std::string WriteLIF(std::size_t cells);

/// The ports at which a carrier is loaded and unloaded.
[[nodiscard]] std::string GetSource(std::size_t cell);
[[nodiscard]] std::string GetTarget(std::size_t cell);

/// Start node of the cell's robot.
[[nodiscard]] std::string GetStartNode(std::size_t cell);

} // namespace ACS::Load::CellSite

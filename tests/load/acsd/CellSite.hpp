#pragma once

#include <cstddef>
#include <string>

/// A floor of cells, one for each robot: a ring of lanes with two ports, a lane to each neighbour. A robot that works in its
/// own cell never meets another one, whatever the reservations. Every cell is reachable from every other, so that a route
/// search covers the whole floor. A cell may have parking positions, each on its own spur. Cells are numbered from 1.
namespace ACS::Load::CellSite
{

inline constexpr const char* VEHICLE_TYPE = "lr-base";

inline constexpr std::size_t MOST_PARKING = 2; ///< Parking positions of a cell.

/// The LIF file for acsd and vda-sim, with this number of parking positions in each cell.
[[nodiscard]] std::string WriteLIF(std::size_t cells, std::size_t parking);

/// The ports at which a carrier is loaded and unloaded.
[[nodiscard]] std::string GetSource(std::size_t cell);
[[nodiscard]] std::string GetTarget(std::size_t cell);

/// The station of a parking position of the cell, from 1, and the node on which a robot parks there.
[[nodiscard]] std::string GetParking(std::size_t cell, std::size_t number);
[[nodiscard]] std::string GetParkingNode(std::size_t cell, std::size_t number);

/// The other cell of a pair of neighbours in a row: that of 1 is 2, and that of 2 is 1.
[[nodiscard]] std::size_t GetNeighbour(std::size_t cell);

/// Start node of the cell's robot, in a site without parking positions.
[[nodiscard]] std::string GetStartNode(std::size_t cell);

} // namespace ACS::Load::CellSite

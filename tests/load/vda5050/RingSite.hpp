#pragma once

#include <acs/vda5050/OrderBuilder.hpp>

#include <cstddef>
#include <string>

/// A ring of nodes some metres apart, wide enough to drive around without braking: a route of any length.
namespace ACS::Load::RingSite
{

inline constexpr std::size_t NODES = 500;
inline constexpr double METRES_APART = 4.0;
inline constexpr double METRES_PER_SECOND = 1.2;

/// As LIF, for vda-sim.
[[nodiscard]] std::string WriteLIF();

[[nodiscard]] std::size_t GetNodeIndex(const std::string& nodeID);

/// The route around the ring from this node.
[[nodiscard]] VDA5050::OrderBuilder MakeRoute(std::string orderID, std::size_t firstNode, std::size_t edges);

} // namespace ACS::Load::RingSite

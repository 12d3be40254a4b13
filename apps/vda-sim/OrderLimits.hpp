#pragma once

#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace ACS::VdaSim
{

// Limits of the orders for a virtual vehicle. The counts are in its factsheet too.

constexpr double MIN_SPEED = 0.01;      ///< m/s; a slower order could hardly be completed or cancelled.
constexpr double MIN_TURN_SPEED = 0.01; ///< rad/s
constexpr double MAX_REACH = 10'000.0;  ///< m from the first node of the site.

/// Of a trajectory: the time to evaluate a point grows with the square of the degree.
constexpr std::uint32_t MAX_DEGREE = 10;
constexpr std::uint32_t MAX_CONTROL_POINTS = 100;

/// Whether a vehicle of this site may be sent to this point, metres.
[[nodiscard]] bool IsInReach(const Planning::SiteMap& site, double x, double y);

/// Why a vehicle of this site cannot drive the order: unknown nodes, speeds that are too low, places that are too far,
/// curves that take too long to evaluate. Empty if it can. The order has passed ValidateOrder.
[[nodiscard]] std::vector<VDA5050::OrderViolation> FindUndrivable(
    const VDA5050::OrderMessage& order,
    const Planning::SiteMap& site);

/// Nodes on maps that are on the vehicle in DISABLED versions only. Empty if there are none; a map that the order enables
/// itself is not one of them.
[[nodiscard]] std::vector<VDA5050::OrderViolation> FindDisabledMaps(
    const VDA5050::OrderMessage& order,
    const std::set<std::string>& disabledMapIDs);

} // namespace ACS::VdaSim

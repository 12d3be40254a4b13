#pragma once

#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/OrderValidator.hpp>

#include <cstdint>
#include <vector>

namespace ACS::VdaSim
{

// What an order may ask of a virtual vehicle. The counts are in its factsheet too.

constexpr double MIN_SPEED = 0.01;      ///< m/s; a slower vehicle would stand for ever, and no cancel would end that.
constexpr double MIN_TURN_SPEED = 0.01; ///< rad/s
constexpr double MAX_REACH = 10'000.0;  ///< m from the first node of the site.

/// Of a trajectory: the time that one point of it takes grows with the square of the degree.
constexpr std::uint32_t MAX_DEGREE = 10;
constexpr std::uint32_t MAX_CONTROL_POINTS = 100;

/// Whether a vehicle of this site may be sent there, metres.
[[nodiscard]] bool IsInReach(const Planning::SiteMap& site, double x, double y);

/// Why a vehicle of this site cannot drive the order: nodes that it does not know, speeds and places that would keep it
/// for ever, curves that are too dear. Empty where it can. The order is one that ValidateOrder found right.
[[nodiscard]] std::vector<VDA5050::OrderViolation> FindUndrivable(
    const VDA5050::OrderMessage& order,
    const Planning::SiteMap& site);

} // namespace ACS::VdaSim

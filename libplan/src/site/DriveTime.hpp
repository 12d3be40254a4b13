#pragma once

#include <acs/plan/Router.hpp>

#include <optional>

namespace ACS::Planning
{

/// The time to drive metres along an edge for which the map gives this speed, if any.
[[nodiscard]] inline double GetDriveSeconds(double length, const std::optional<double>& maxSpeedOrNull)
{
    return length / maxSpeedOrNull.value_or(DEFAULT_SPEED);
}

} // namespace ACS::Planning

#pragma once

#include <acs/core/NurbsCurve.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace ACS::VdaSim
{

using Core::MapPoint;

/// Path of one leg, by distance from its beginning: a straight line, or the samples of a curve. Pure.
class LegPath
{
    struct Sample
    {
        MapPoint point;
        double way = 0.0;       ///< m from the beginning.
        double maxSpeed = 0.0;  ///< m/s there; what the bends ahead and the speed at the end allow.
        double bendSpeed = 0.0; ///< m/s that the bend itself allows.
        double bend = 0.0;      ///< 1/m, not signed; infinite in a corner.
    };

    std::vector<Sample> _samples; ///< At least one; no two at the same place.

public:
    /// Drops consecutive points at the same place.
    explicit LegPath(const std::vector<MapPoint>& points);

    /// From the first point to the last; along the curve if there is one.
    [[nodiscard]] static LegPath Create(
        const MapPoint& from,
        const MapPoint& to,
        const std::optional<VDA5050::Trajectory>& curveOrNull);

    /// Computes the limits of GetAllowedSpeed: in bends from the turn speed and the lateral acceleration, but never less than
    /// the corner speed; towards the end from the exit speed and the deceleration.
    void Plan(double turnSpeed, double lateralAcceleration, double cornerSpeed, double deceleration, double exitSpeed);

    /// m/s; after Plan.
    [[nodiscard]] double GetAllowedSpeed(double way, double deceleration) const;

    [[nodiscard]] double GetLength() const;
    [[nodiscard]] MapPoint GetPoint(double way) const;
    /// rad; nullopt if the path has no length.
    [[nodiscard]] std::optional<double> GetDirectionOrNull(double way) const;
    [[nodiscard]] std::size_t CountSamples() const;

private:
    [[nodiscard]] std::size_t FindSegment(double way) const;
};

} // namespace ACS::VdaSim

#pragma once

#include "vda-sim/NurbsCurve.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace ACS::VdaSim
{

/// The way of one leg, measured along itself: a straight line, or the samples of a curve. Pure.
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
    /// No two points at the same place are needed, and none are kept.
    explicit LegPath(const std::vector<MapPoint>& points);

    /// From the first point to the last; along the curve where there is one.
    [[nodiscard]] static LegPath Create(
        const MapPoint& from,
        const MapPoint& to,
        const std::optional<VDA5050::Trajectory>& curveOrNull);

    /// What GetAllowedSpeed then respects: the turn speed and the lateral acceleration in bends, but never less than the
    /// corner speed, and the exit speed at the end, reached with the deceleration.
    void Plan(double turnSpeed, double lateralAcceleration, double cornerSpeed, double deceleration, double exitSpeed);

    /// m/s; after Plan.
    [[nodiscard]] double GetAllowedSpeed(double way, double deceleration) const;

    [[nodiscard]] double GetLength() const;
    [[nodiscard]] MapPoint GetPoint(double way) const;
    /// rad; nothing where the path has no length.
    [[nodiscard]] std::optional<double> GetDirectionOrNull(double way) const;
    [[nodiscard]] std::size_t CountSamples() const;

private:
    [[nodiscard]] std::size_t FindSegment(double way) const;
};

} // namespace ACS::VdaSim

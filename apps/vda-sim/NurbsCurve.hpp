#pragma once

#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <vector>

namespace ACS::VdaSim
{

/// Metres in the map's frame.
struct MapPoint
{
    double x = 0.0;
    double y = 0.0;

    bool operator==(const MapPoint&) const = default;
};

/// The trajectory of an edge (VDA5050, section 7): a NURBS, evaluated by de Boor's rule. Pure.
class NurbsCurve
{
    struct Weighted
    {
        double x = 0.0;
        double y = 0.0;
        double weight = 1.0;
    };

    std::size_t _degree;
    std::vector<double> _knots;
    std::vector<Weighted> _points; ///< x and y times the weight.

public:
    /// The trajectory has passed ValidateOrder.
    explicit NurbsCurve(const VDA5050::Trajectory& trajectory);

    /// The point at the parameter, which is clamped to GetBegin and GetEnd.
    [[nodiscard]] MapPoint GetPoint(double parameter) const;
    [[nodiscard]] double GetBegin() const;
    [[nodiscard]] double GetEnd() const;

    /// Points along the curve, about `spacing` metres apart, both ends included. At most `maxPoints`, which is two or more
    /// and bounds the work too. If the limit allows, the knots are included; a curve of degree 1 gives its corners.
    [[nodiscard]] std::vector<MapPoint> Sample(double spacing, std::size_t maxPoints) const;

private:
    /// The distinct knots, reduced so that at most `maxSpans` spans are between them.
    [[nodiscard]] std::vector<double> FindSpans(std::size_t maxSpans) const;
    [[nodiscard]] std::size_t FindSpan(double parameter) const;
};

} // namespace ACS::VdaSim

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
    /// The trajectory is one that ValidateOrder found right.
    explicit NurbsCurve(const VDA5050::Trajectory& trajectory);

    /// The point at the parameter, from GetBegin to GetEnd; beyond them it is the nearest end.
    [[nodiscard]] MapPoint GetPoint(double parameter) const;
    [[nodiscard]] double GetBegin() const;
    [[nodiscard]] double GetEnd() const;

    /// Points along the curve, its ends among them, about `spacing` metres apart, and no more than the limit, two or more:
    /// also of work. Its knots are among them, and a curve of degree 1 is its corners, where the limit leaves room.
    [[nodiscard]] std::vector<MapPoint> Sample(double spacing, std::size_t maxPoints) const;

private:
    /// The places of the knots, each once; so few that there are no more spans between them than the limit.
    [[nodiscard]] std::vector<double> FindSpans(std::size_t maxSpans) const;
    [[nodiscard]] std::size_t FindSpan(double parameter) const;
};

} // namespace ACS::VdaSim

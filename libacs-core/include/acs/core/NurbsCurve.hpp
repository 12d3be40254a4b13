#pragma once

#include <acs/core/Api.hpp>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace ACS::Core
{

/// Metres in the frame of a map.
struct MapPoint
{
    double x = 0.0; ///< Metres.
    double y = 0.0; ///< Metres.

    bool operator==(const MapPoint&) const = default;
};

/// A control point of a curve, in metres.
struct CurvePoint
{
    double x = 0.0;               ///< Metres.
    double y = 0.0;               ///< Metres.
    std::optional<double> weight; ///< Absent: 1.

    bool operator==(const CurvePoint&) const = default;
};

/// A NURBS as maps and orders describe it: as many knots as points + degree + 1, each in [0, 1].
struct Nurbs
{
    std::size_t degree = 1;         ///< At least 1.
    std::vector<double> knots;      ///< In ascending order.
    std::vector<CurvePoint> points; ///< Control points: more than the degree.

    bool operator==(const Nurbs&) const = default;
};

/// Which rule the description breaks; empty where it keeps all. One that keeps them has a point everywhere.
[[nodiscard]] ACS_API std::string_view FindCurveFault(const Nurbs& curve);

/// A NURBS, evaluated by de Boor's rule. Pure.
class ACS_API NurbsCurve
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
    /// The curve has no fault (FindCurveFault).
    explicit NurbsCurve(const Nurbs& curve);

    /// The point at the parameter, which is clamped to GetBegin and GetEnd.
    [[nodiscard]] MapPoint GetPoint(double parameter) const;
    /// The parameter of the first point.
    [[nodiscard]] double GetBegin() const;
    /// The parameter of the last point.
    [[nodiscard]] double GetEnd() const;

    /// Points along the curve, about `spacing` metres apart, both ends included. At most `maxPoints`, which is two or more
    /// and bounds the work too. If the limit allows, the knots are included; a curve of degree 1 gives its corners. A spacing
    /// that is not above 0 counts as the smallest one: as many points as the limit allows.
    [[nodiscard]] std::vector<MapPoint> Sample(double spacing, std::size_t maxPoints) const;

private:
    /// The distinct knots, reduced so that at most `maxSpans` spans are between them.
    [[nodiscard]] std::vector<double> FindSpans(std::size_t maxSpans) const;
    [[nodiscard]] std::size_t FindSpan(double parameter) const;
};

} // namespace ACS::Core

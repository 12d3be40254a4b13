#include <acs/core/NurbsCurve.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ACS::Core
{

namespace
{

double GetWeight(const CurvePoint& point)
{
    return point.weight.value_or(1.0);
}

/// Negative ones pull the curve out of the hull of its points; where all that bear on a place are 0 there is no curve.
bool HasUsableWeights(const Nurbs& curve)
{
    const auto isUsable = [](const CurvePoint& point) {
        return std::isfinite(GetWeight(point)) && GetWeight(point) >= 0.0;
    };
    const auto bearing = static_cast<std::ptrdiff_t>(curve.degree) + 1;
    const auto lost = std::search_n(
        curve.points.begin(),
        curve.points.end(),
        bearing,
        0.0,
        [](const CurvePoint& point, double weight) { return GetWeight(point) <= weight; });
    return std::ranges::all_of(curve.points, isUsable) && lost == curve.points.end()
        && GetWeight(curve.points.front()) > 0.0 && GetWeight(curve.points.back()) > 0.0;
}

} // namespace

std::string_view FindCurveFault(const Nurbs& curve)
{
    const bool bCounts = curve.degree > 0 && curve.points.size() > curve.degree
        && curve.knots.size() == curve.points.size() + curve.degree + 1;
    const bool bRange = std::ranges::all_of(curve.knots, [](double knot) { return knot >= 0.0 && knot <= 1.0; });
    if (!bCounts || !bRange || !std::ranges::is_sorted(curve.knots))
    {
        return "a trajectory must have control points + degree + 1 knots from 0 to 1, none less than the one before";
    }
    const bool bFinite = std::ranges::all_of(curve.points, [](const CurvePoint& point) {
        return std::isfinite(point.x) && std::isfinite(point.y);
    });
    if (!bFinite || !HasUsableWeights(curve))
    {
        return "a trajectory needs finite control points, and weights that are not negative and not 0 throughout";
    }
    return {};
}

NurbsCurve::NurbsCurve(const Nurbs& curve)
    : _degree(curve.degree),
      _knots(curve.knots)
{
    assert(_knots.size() == curve.points.size() + _degree + 1 && curve.points.size() > _degree);
    _points.reserve(curve.points.size());
    for (const CurvePoint& point : curve.points)
    {
        const double weight = GetWeight(point);
        _points.push_back({point.x * weight, point.y * weight, weight});
    }
}

double NurbsCurve::GetBegin() const
{
    return _knots[_degree];
}

double NurbsCurve::GetEnd() const
{
    return _knots[_points.size()];
}

/// The span in which the parameter lies; at the end the last one that is not empty.
std::size_t NurbsCurve::FindSpan(double parameter) const
{
    const auto first = _knots.begin() + static_cast<std::ptrdiff_t>(_degree);
    const auto last = _knots.begin() + static_cast<std::ptrdiff_t>(_points.size());
    const auto after = std::upper_bound(first, last, parameter);
    auto span = static_cast<std::size_t>(after - _knots.begin());
    span = std::max(span, _degree + 1) - 1;
    while (span > _degree && _knots[span] == _knots[span + 1])
    {
        --span;
    }
    return span;
}

MapPoint NurbsCurve::GetPoint(double parameter) const
{
    const double place = std::clamp(parameter, GetBegin(), std::max(GetBegin(), GetEnd()));
    const std::size_t span = FindSpan(place);
    const auto first = _points.begin() + static_cast<std::ptrdiff_t>(span - _degree);
    std::vector<Weighted> points(first, first + static_cast<std::ptrdiff_t>(_degree) + 1);
    for (std::size_t level = 1; level <= _degree; ++level)
    {
        for (std::size_t i = _degree; i >= level; --i)
        {
            const double low = _knots[span - _degree + i];
            const double high = _knots[span + 1 + i - level];
            const double part = high > low ? (place - low) / (high - low) : 0.0;
            points[i].x = std::lerp(points[i - 1].x, points[i].x, part);
            points[i].y = std::lerp(points[i - 1].y, points[i].y, part);
            points[i].weight = std::lerp(points[i - 1].weight, points[i].weight, part);
        }
    }
    const Weighted& result = points[_degree];
    // With zero weights alone the point is undefined: use the last control point.
    return result.weight > 0.0 ? MapPoint{result.x / result.weight, result.y / result.weight}
                               : MapPoint{_points.back().x, _points.back().y};
}

std::vector<double> NurbsCurve::FindSpans(std::size_t maxSpans) const
{
    std::vector<double> places{GetBegin()};
    for (std::size_t i = _degree + 1; i <= _points.size(); ++i)
    {
        if (_knots[i] > places.back())
        {
            places.push_back(_knots[i]);
        }
    }
    const std::size_t count = places.size() - 1;
    if (count <= maxSpans)
    {
        return places;
    }
    std::vector<double> fewer;
    for (std::size_t i = 0; i <= maxSpans; ++i)
    {
        fewer.push_back(places[i * count / maxSpans]);
    }
    return fewer;
}

std::vector<MapPoint> NurbsCurve::Sample(double spacing, std::size_t maxPoints) const
{
    assert(maxPoints >= 2);
    const double apart = spacing > 0.0 ? spacing : std::numeric_limits<double>::min(); // also for NaN
    const std::vector<double> spans = FindSpans(maxPoints - 1);
    std::vector<MapPoint> samples{GetPoint(spans.front())};
    const std::size_t limit = (maxPoints - 1) / std::max<std::size_t>(1, spans.size() - 1);
    // Estimate the length of each span coarsely, except where it leads straight to the next corner.
    constexpr std::size_t MAX_LOOKS = 8;
    const std::size_t looks = _degree <= 1 ? 0 : std::min(limit, MAX_LOOKS);
    for (std::size_t i = 1; i < spans.size(); ++i)
    {
        const auto at = [&](std::size_t step, std::size_t steps) {
            const double part = static_cast<double>(step) / static_cast<double>(steps);
            return GetPoint(step == steps ? spans[i] : std::lerp(spans[i - 1], spans[i], part));
        };
        double length = 0.0;
        MapPoint from = samples.back();
        for (std::size_t step = 1; step <= looks; ++step)
        {
            const MapPoint to = at(step, looks);
            length += std::hypot(to.x - from.x, to.y - from.y);
            from = to;
        }
        const double wanted = std::isfinite(length) ? std::ceil(length / apart) : 1.0;
        const auto steps = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(limit)));
        for (std::size_t step = 1; step <= steps; ++step)
        {
            samples.push_back(at(step, steps));
        }
    }
    return samples;
}

} // namespace ACS::Core

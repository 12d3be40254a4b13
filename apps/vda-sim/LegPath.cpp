#include "vda-sim/LegPath.hpp"

#include <acs/vda5050/TrajectoryCurve.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace ACS::VdaSim
{
namespace
{

constexpr double SAME_PLACE = 1e-6;      ///< m
constexpr double SPACING = 0.05;         ///< m between the samples of a curve.
constexpr std::size_t MAX_SAMPLES = 400; ///< A few kilobytes, however long a curve is.
constexpr double NOT_LIMITED = 1e9;      ///< m/s
constexpr double CORNER_ANGLE = 0.1;     ///< rad from one sample to the next: no bend, but a corner.

double GetDistance(const MapPoint& from, const MapPoint& to)
{
    return std::hypot(to.x - from.x, to.y - from.y);
}

double GetDirection(const MapPoint& from, const MapPoint& to)
{
    return std::atan2(to.y - from.y, to.x - from.x);
}

} // namespace

LegPath::LegPath(const std::vector<MapPoint>& points)
{
    for (const MapPoint& point : points)
    {
        const double step = _samples.empty() ? 0.0 : GetDistance(_samples.back().point, point);
        if (_samples.empty() || step > SAME_PLACE)
        {
            const double before = _samples.empty() ? 0.0 : _samples.back().way;
            _samples.push_back({point, before + step, NOT_LIMITED, NOT_LIMITED, 0.0});
        }
        else if (_samples.size() > 1)
        {
            _samples.back().point = point; // so that the path ends exactly at the last point
        }
    }
    for (std::size_t i = 1; i + 1 < _samples.size(); ++i)
    {
        const double before = GetDirection(_samples[i - 1].point, _samples[i].point);
        const double after = GetDirection(_samples[i].point, _samples[i + 1].point);
        const double turn = std::abs(std::remainder(after - before, 2.0 * std::numbers::pi));
        const double around = (_samples[i + 1].way - _samples[i - 1].way) / 2.0;
        _samples[i].bend = turn > CORNER_ANGLE ? std::numeric_limits<double>::infinity() : turn / around;
    }
}

LegPath LegPath::Create(const MapPoint& from, const MapPoint& to, const std::optional<VDA5050::Trajectory>& curveOrNull)
{
    std::vector<MapPoint> points{from};
    if (curveOrNull.has_value())
    {
        const Core::NurbsCurve nurbs(VDA5050::MakeNurbs(*curveOrNull));
        const std::vector<MapPoint> curve = nurbs.Sample(SPACING, MAX_SAMPLES);
        // A vehicle that is past the beginning joins the curve after the nearest point.
        const auto nearest =
            std::ranges::min_element(curve, {}, [&from](const MapPoint& point) { return GetDistance(from, point); });
        points.insert(points.end(), std::next(nearest), curve.end());
    }
    points.push_back(to);
    return LegPath(points);
}

void LegPath::Plan(
    double turnSpeed,
    double lateralAcceleration,
    double cornerSpeed,
    double deceleration,
    double exitSpeed)
{
    _samples.back().maxSpeed = exitSpeed;
    for (std::size_t i = _samples.size() - 1; i-- > 0;)
    {
        Sample& sample = _samples[i];
        const Sample& next = _samples[i + 1];
        if (sample.bend > 0.0)
        {
            const double inBend = std::min(turnSpeed / sample.bend, std::sqrt(lateralAcceleration / sample.bend));
            sample.bendSpeed = std::max(inBend, cornerSpeed);
        }
        // v² = v0² + 2as, backwards from what the next place allows.
        const double braked = std::sqrt(next.maxSpeed * next.maxSpeed + 2.0 * deceleration * (next.way - sample.way));
        sample.maxSpeed = std::min(sample.bendSpeed, braked);
    }
}

double LegPath::GetAllowedSpeed(double way, double deceleration) const
{
    if (_samples.size() < 2)
    {
        return _samples.back().maxSpeed;
    }
    const Sample& last = _samples[FindSegment(way)];
    const Sample& next = _samples[FindSegment(way) + 1];
    const double left = std::max(next.way - way, 0.0);
    const double braked = std::sqrt(next.maxSpeed * next.maxSpeed + 2.0 * deceleration * left);
    // A bend continues between two of its samples; beside a corner the path is straight.
    return std::min(braked, std::max(last.bendSpeed, next.bendSpeed));
}

double LegPath::GetLength() const
{
    return _samples.back().way;
}

/// The index of the sample before the place; there are at least two.
std::size_t LegPath::FindSegment(double way) const
{
    const auto after = std::ranges::upper_bound(_samples, way, {}, &Sample::way);
    const auto index = static_cast<std::size_t>(std::distance(_samples.begin(), after));
    return std::clamp<std::size_t>(index, 1, _samples.size() - 1) - 1;
}

MapPoint LegPath::GetPoint(double way) const
{
    if (way >= GetLength() || _samples.size() < 2)
    {
        return _samples.back().point;
    }
    const Sample& from = _samples[FindSegment(way)];
    const Sample& to = _samples[FindSegment(way) + 1];
    const double part = std::clamp((way - from.way) / (to.way - from.way), 0.0, 1.0);
    return {std::lerp(from.point.x, to.point.x, part), std::lerp(from.point.y, to.point.y, part)};
}

std::optional<double> LegPath::GetDirectionOrNull(double way) const
{
    if (_samples.size() < 2)
    {
        return std::nullopt;
    }
    const std::size_t segment = FindSegment(way);
    return GetDirection(_samples[segment].point, _samples[segment + 1].point);
}

std::size_t LegPath::CountSamples() const
{
    return _samples.size();
}

} // namespace ACS::VdaSim

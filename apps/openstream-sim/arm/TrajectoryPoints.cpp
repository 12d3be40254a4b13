#include "arm/TrajectoryPoints.hpp"

#include "arm/TrajectoryFollower.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace ACS::OpenStreamSim
{

namespace
{

using Json::Value;

constexpr double DEGREES_PER_RADIAN = 180.0 / std::numbers::pi;
constexpr double ROUNDING = 1e-4; ///< deg: clients write radians with a few digits, also at the end of an axis's range.
constexpr std::size_t FEWEST_POINTS = 2;
constexpr std::string_view POINT_PREFIX = "point_";

TrajectoryError Fail(ETrajectoryError code, std::string sentence)
{
    return TrajectoryError{code, EApiError::None, std::move(sentence)};
}

const Value* FindOrNull(const Value& object, const char* name)
{
    const auto found = object.FindMember(name);
    return found == object.MemberEnd() ? nullptr : &found->value;
}

std::string_view GetText(const Value& value)
{
    return {value.GetString(), value.GetStringLength()};
}

/// j1 to j6, in this order.
bool IsListOfJoints(const Value& names)
{
    if (!names.IsArray() || names.Size() != AXES)
    {
        return false;
    }
    int number = 0;
    for (const Value& name : names.GetArray())
    {
        ++number;
        if (!name.IsString() || GetText(name) != fmt::format("j{}", number))
        {
            return false;
        }
    }
    return true;
}

/// 0 for point_1; nullopt if the name is not one of `count` points.
std::optional<std::size_t> ParsePointIndexOrNull(std::string_view name, std::size_t count)
{
    if (!name.starts_with(POINT_PREFIX))
    {
        return std::nullopt;
    }
    const std::string_view digits = name.substr(POINT_PREFIX.size());
    const std::optional<std::size_t> number = Core::ParseNumberOrNull<std::size_t>(digits);
    const bool bPoint = number.has_value() && digits.front() != '0' && *number <= count;
    return bPoint ? std::optional(*number - 1) : std::nullopt;
}

/// Converts radians into degrees; false if one is not a number or out of the axis's range.
bool TryReadPositions(const Value& positions, JointVector& positionOut)
{
    if (!positions.IsArray() || positions.Size() != AXES)
    {
        return false;
    }
    std::size_t axis = 0;
    for (const Value& angle : positions.GetArray())
    {
        if (!angle.IsNumber())
        {
            return false;
        }
        const AxisLimits& limits = AXIS_LIMITS.at(axis);
        const double degrees = angle.GetDouble() * DEGREES_PER_RADIAN;
        if (!(degrees >= limits.lowest - ROUNDING && degrees <= limits.highest + ROUNDING))
        {
            return false;
        }
        positionOut.at(axis) = std::clamp(degrees, limits.lowest, limits.highest);
        ++axis;
    }
    return true;
}

TrajectoryError ReadPoint(const Value& value, const std::string& name, TimedPoint& pointOut)
{
    if (!value.IsObject())
    {
        return Fail(ETrajectoryError::PointNoObject, name + ": expected an object");
    }
    const Value* const positionsOrNull = FindOrNull(value, "positions");
    if (positionsOrNull == nullptr)
    {
        return Fail(ETrajectoryError::NoPositions, name + ".positions: expected a value");
    }
    if (!TryReadPositions(*positionsOrNull, pointOut.position))
    {
        return Fail(
            ETrajectoryError::BadPositions,
            fmt::format("{}.positions: expected {} angles in radians, each in its axis's range", name, AXES));
    }
    const Value* const timeOrNull = FindOrNull(value, "time_from_start");
    if (timeOrNull == nullptr)
    {
        return Fail(ETrajectoryError::NoTime, name + ".time_from_start: expected a value");
    }
    pointOut.time = timeOrNull->IsNumber() ? timeOrNull->GetDouble() : -1.0;
    if (!(pointOut.time >= 0.0 && pointOut.time <= LONGEST_TRAJECTORY))
    {
        return Fail(
            ETrajectoryError::BadTime,
            fmt::format("{}.time_from_start: expected seconds from 0 to {}", name, LONGEST_TRAJECTORY));
    }
    return {};
}

TrajectoryError ReadPoints(const Value& object, TimedPoints& pointsOut)
{
    const std::size_t count = object.MemberCount();
    std::vector<const Value*> ordered(count, nullptr);
    for (const auto& member : object.GetObject())
    {
        const std::optional<std::size_t> index = ParsePointIndexOrNull(GetText(member.name), count);
        if (!index.has_value() || ordered[*index] != nullptr)
        {
            return Fail(
                ETrajectoryError::PointsNoObject,
                fmt::format("points: expected point_1 to point_{}, each once", count));
        }
        ordered[*index] = &member.value;
    }
    TimedPoints points(count);
    for (std::size_t index = 0; index < count; ++index)
    {
        const std::string name = fmt::format("points.{}{}", POINT_PREFIX, index + 1);
        TrajectoryError error = ReadPoint(*ordered[index], name, points[index]);
        if (error.code != ETrajectoryError::None)
        {
            return error;
        }
        if (index > 0 && points[index].time <= points[index - 1].time)
        {
            return Fail(
                ETrajectoryError::BadTime,
                name + ".time_from_start: expected more than that of the previous point");
        }
    }
    pointsOut = std::move(points);
    return {};
}

} // namespace

TrajectoryError ReadTrajectory(const std::optional<Core::JsonText>& bodyOrNull, TimedPoints& pointsOut)
{
    Json::JsonDocument document;
    const std::string text = bodyOrNull.has_value() ? bodyOrNull->GetText() : "{}";
    const Core::Result<const Value*> root = document.Parse(text, Json::ParseLimits{});
    if (!root.has_value())
    {
        return TrajectoryError{ETrajectoryError::None, EApiError::BadInput, Core::Describe(root.error())};
    }
    if (!(*root)->IsObject())
    {
        return TrajectoryError{ETrajectoryError::None, EApiError::BadInput, "expected an object"};
    }
    const Value* const namesOrNull = FindOrNull(**root, "joint_names");
    if (namesOrNull == nullptr)
    {
        return Fail(ETrajectoryError::NoJointNames, "joint_names: expected a value");
    }
    if (!IsListOfJoints(*namesOrNull))
    {
        return Fail(
            ETrajectoryError::BadJointNames,
            fmt::format("joint_names: expected j1 to j{} in this order", AXES));
    }
    const Value* const objectOrNull = FindOrNull(**root, "points");
    if (objectOrNull == nullptr)
    {
        return Fail(ETrajectoryError::NoPoints, "points: expected a value");
    }
    if (!objectOrNull->IsObject())
    {
        return Fail(ETrajectoryError::PointsNoObject, "points: expected an object");
    }
    const std::size_t count = objectOrNull->MemberCount();
    if (count < FEWEST_POINTS)
    {
        return Fail(ETrajectoryError::TooFewPoints, fmt::format("points: expected at least {}", FEWEST_POINTS));
    }
    if (count > TRAJECTORY_CAPACITY)
    {
        return Fail(ETrajectoryError::TooManyPoints, fmt::format("points: expected at most {}", TRAJECTORY_CAPACITY));
    }
    return ReadPoints(*objectOrNull, pointsOut);
}

} // namespace ACS::OpenStreamSim

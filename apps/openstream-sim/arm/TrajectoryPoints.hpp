#pragma once

#include "api/EApiError.hpp"
#include "arm/AxisLimits.hpp"
#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::OpenStreamSim
{

/// The body of joint_traject_insert_point.
struct StreamedPoint
{
    double interval = 0.0;       ///< s
    double timeFromStart = -1.0; ///< s; negative: an interval after the previous point.
    double lookAheadTime = 0.0;  ///< s
    std::vector<double> point;   ///< deg, one for each axis.
};

/// One of the points of joint_traject_insert_points.
struct TimedPoint
{
    JointVector position{}; ///< deg
    double time = 0.0;      ///< s, from the trajectory's start.
};

using TimedPoints = std::vector<TimedPoint>;

/// Errors of joint_traject_insert_points, as numbered in the manual.
enum class ETrajectoryError : std::int32_t
{
    None = 0,
    NoJointNames = -2,
    BadJointNames = -3,
    NoPoints = -4,
    PointsNoObject = -5,
    TooFewPoints = -6,
    TooManyPoints = -7,
    BufferExceeded = -8,
    PointNoObject = -9,
    NoPositions = -10,
    BadPositions = -11,
    NoTime = -12,
    BadTime = -13,
};

/// Why a trajectory is refused: an error of the manual, or why none is accepted now.
struct TrajectoryError
{
    ETrajectoryError code = ETrajectoryError::None;
    EApiError notNow = EApiError::None;
    std::string sentence; ///< Describes the error.
};

/// Maximum time of a point, in s: twelve days.
inline constexpr double LONGEST_TRAJECTORY = 1'000'000.0;

/// Reads the body of joint_traject_insert_points. The points are in the order of their numbers, in degrees, with increasing
/// times; empty on an error. The machine checks them against the arm's position.
[[nodiscard]] TrajectoryError ReadTrajectory(const std::optional<Core::JsonText>& bodyOrNull, TimedPoints& pointsOut);

} // namespace ACS::OpenStreamSim

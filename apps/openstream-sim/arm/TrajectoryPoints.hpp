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
    double timeFromStart = -1.0; ///< s; negative: an interval after the point before.
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

/// Why joint_traject_insert_points refuses, by the numbers of its manual.
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

/// What is wrong with a trajectory; or, where it is none of the manual's mistakes, why none is taken now.
struct TrajectoryError
{
    ETrajectoryError code = ETrajectoryError::None;
    EApiError notNow = EApiError::None;
    std::string sentence; ///< Of the mistake.
};

/// A point's time at most, in s: twelve days.
inline constexpr double LONGEST_TRAJECTORY = 1'000'000.0;

/// Reads the body of joint_traject_insert_points. The points come out in the order of their numbers, in degrees, their
/// times rising; nothing where there is a mistake. Whether they fit to where the arm is, is the machine's to say.
[[nodiscard]] TrajectoryError ReadTrajectory(const std::optional<Core::JsonText>& bodyOrNull, TimedPoints& pointsOut);

} // namespace ACS::OpenStreamSim

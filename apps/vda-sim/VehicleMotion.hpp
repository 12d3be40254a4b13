#pragma once

#include "vda-sim/LegPath.hpp"

#include <cstdint>
#include <optional>

namespace ACS::VdaSim
{

/// Metres and radians in the map's frame; theta in [-pi, pi].
struct Pose
{
    double x = 0.0;
    double y = 0.0;
    double theta = 0.0;

    bool operator==(const Pose&) const = default;
};

/// Limits of the vehicle's drives.
struct MotionLimits
{
    double acceleration = 0.6;          ///< m/s²
    double deceleration = 0.6;          ///< m/s²
    double emergencyDeceleration = 3.0; ///< m/s²
    double lateralAcceleration = 0.5;   ///< m/s², in bends.
    double maxSpeed = 1.5;              ///< m/s
    double maxTurnSpeed = 1.2;          ///< rad/s
    double turnAcceleration = 2.0;      ///< rad/s², except in bends.
    double cornerSpeed = 0.3;           ///< m/s where the direction changes without a stop.
    double turnTolerance = 0.02;        ///< rad: smaller turns do not stop a vehicle at a node.
};

/// The movement to the next node.
struct MotionLeg
{
    LegPath path{{MapPoint{}}};
    std::optional<double> heading;    ///< rad, on the whole path; absent: along it.
    double relativeHeading = 0.0;     ///< rad relative to the path if heading is absent; pi: backwards.
    double maxSpeed = 1.0;            ///< m/s
    double maxTurnSpeed = 1.2;        ///< rad/s
    double exitSpeed = 0.0;           ///< m/s at the end; 0: it stops there.
    bool bTurnBefore = false;         ///< Turn to the heading before driving, else while driving.
    std::optional<double> finalTheta; ///< Turn to it at the end.
};

/// How hard a vehicle brakes, in ascending order.
enum class EBrake : std::uint8_t
{
    None,
    Service,
    Emergency,
    Block, ///< Stops instantly, which no real vehicle can.
};

/// [-pi, pi]
[[nodiscard]] double NormaliseAngle(double angle);

/// Moves one vehicle in simulated time along one leg at a time, with limited acceleration, slower in bends, and with a
/// smooth stop at the end. Pure: time is a parameter, in seconds.
class VehicleMotion
{
public:
    /// Maximum slope when leaving the route: metres aside for each metre driven.
    static constexpr double SWERVE_SLOPE = 0.5;

private:
    MotionLimits _limits;
    Pose _pose;
    std::optional<MotionLeg> _leg;
    double _speed = 0.0;
    double _turnSpeed = 0.0;
    double _driven = 0.0; ///< On this leg.
    double _offset = 0.0; ///< m to the left of the path.
    double _wantedOffset = 0.0;
    EBrake _brake = EBrake::None;
    bool _bAtTarget = false; ///< Arrived, and turning to finalTheta.
    bool _bFollows = false;  ///< Has the heading of the leg; from now on the heading follows the bends.

public:
    VehicleMotion(const MotionLimits& limits, const Pose& pose);

    /// Begins a leg at the current pose and speed; the brake is unchanged.
    void Begin(MotionLeg leg);
    /// Changes the speed at the end of the leg under way.
    void SetExitSpeed(double exitSpeed);
    /// Stops the vehicle on its path; EBrake::None lets it continue.
    void SetBrake(EBrake brake);
    /// Distance to the left of the path from now on, limited so that the vehicle is back on it at the end; negative: right.
    void SetOffset(double offset);
    /// Drops the leg and stops.
    void Abandon();
    /// Sets the pose; only while it is stationary.
    void Place(const Pose& pose);

    /// Advances the simulated time; true when the leg ends.
    [[nodiscard]] bool TryFinishLeg(double seconds);

    [[nodiscard]] const Pose& GetPose() const noexcept;
    [[nodiscard]] double GetSpeed() const noexcept;     ///< m/s along the way.
    [[nodiscard]] double GetTurnSpeed() const noexcept; ///< rad/s, signed.
    [[nodiscard]] double GetDriven() const noexcept;    ///< m on the leg under way, or on the last one.
    /// Forward and sideways in the vehicle's own frame, m/s.
    [[nodiscard]] double GetForwardSpeed() const;
    [[nodiscard]] double GetSidewaysSpeed() const;
    [[nodiscard]] bool HasLeg() const noexcept;
    /// Neither drives nor turns nor has to.
    [[nodiscard]] bool IsStanding() const noexcept;

private:
    [[nodiscard]] bool TryTurn(double theta, double seconds);
    [[nodiscard]] bool TryArrive(double seconds);
    void Brake(double seconds);
    [[nodiscard]] double GetRemaining() const;
    [[nodiscard]] double GetDirection() const;
    [[nodiscard]] double GetHeading() const;
    void PlanSpeed();
    void ChangeSpeed(double seconds);
    void Drive(double seconds);
};

} // namespace ACS::VdaSim

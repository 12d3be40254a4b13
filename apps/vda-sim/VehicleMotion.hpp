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

/// What the vehicle's drives can do.
struct MotionLimits
{
    double acceleration = 0.6;          ///< m/s²
    double deceleration = 0.6;          ///< m/s²
    double emergencyDeceleration = 3.0; ///< m/s²
    double lateralAcceleration = 0.5;   ///< m/s², in bends.
    double maxSpeed = 1.5;              ///< m/s
    double maxTurnSpeed = 1.2;          ///< rad/s
    double turnAcceleration = 2.0;      ///< rad/s², but in bends, which it takes as they come.
    double cornerSpeed = 0.3;           ///< m/s where the direction changes without a stop.
    double turnTolerance = 0.02;        ///< rad: a vehicle that passes a node turns no less than this there.
};

/// One way to a node.
struct MotionLeg
{
    LegPath path{{MapPoint{}}};
    std::optional<double> heading;    ///< On the whole way; absent: along it.
    double relativeHeading = 0.0;     ///< rad against the way, where heading is absent; pi: backwards.
    double maxSpeed = 1.0;            ///< m/s
    double maxTurnSpeed = 1.2;        ///< rad/s
    double exitSpeed = 0.0;           ///< m/s at the end; 0: it stops there.
    bool bTurnBefore = false;         ///< Turn to the heading before driving off, else on the way.
    std::optional<double> finalTheta; ///< Turn to it at the end.
};

/// How hard a vehicle comes to a stand. The harder, the greater.
enum class EBrake : std::uint8_t
{
    None,
    Service,
    Emergency,
    Block, ///< At once, as nothing on wheels can.
};

/// [-pi, pi]
[[nodiscard]] double NormaliseAngle(double angle);

/// Moves one vehicle in simulated time: with limited acceleration, slower in bends, along one leg at a time, and to a
/// smooth stand at its end. Pure: time comes in as seconds.
class VehicleMotion
{
public:
    /// A vehicle leaves its way no steeper than this: metres aside for each metre driven.
    static constexpr double SWERVE_SLOPE = 0.5;

private:
    MotionLimits _limits;
    Pose _pose;
    std::optional<MotionLeg> _leg;
    double _speed = 0.0;
    double _turnSpeed = 0.0;
    double _driven = 0.0; ///< On this leg.
    double _offset = 0.0; ///< m to the left of the way.
    double _wantedOffset = 0.0;
    EBrake _brake = EBrake::None;
    bool _bAtTarget = false; ///< There, and turning to finalTheta.
    bool _bFollows = false;  ///< Looks where it should, and from now on where the bends lead.

public:
    VehicleMotion(const MotionLimits& limits, const Pose& pose);

    /// Goes on from where it is, at the speed that it has; the brake stays as it is.
    void Begin(MotionLeg leg);
    /// Changes the speed at the end of the leg under way.
    void SetExitSpeed(double exitSpeed);
    /// Comes to a stand on the way, and drives on with EBrake::None.
    void SetBrake(EBrake brake);
    /// How far left of the way it drives from now on, as far as it comes back before the end; negative: right.
    void SetOffset(double offset);
    /// Forgets the leg, and stands.
    void Abandon();
    /// Where it is after all; only while it stands, and without a leg.
    void Place(const Pose& pose);

    /// Lets the time pass; true when the leg has come to its end.
    [[nodiscard]] bool TryFinishLeg(double seconds);

    [[nodiscard]] const Pose& GetPose() const noexcept;
    [[nodiscard]] double GetSpeed() const noexcept;     ///< m/s along the way.
    [[nodiscard]] double GetTurnSpeed() const noexcept; ///< rad/s, signed.
    [[nodiscard]] double GetDriven() const noexcept;    ///< m on the leg under way, or on the last one.
    /// Forward and sideways in the vehicle's own frame, m/s.
    [[nodiscard]] double GetForwardSpeed() const;
    [[nodiscard]] double GetSidewaysSpeed() const;
    [[nodiscard]] bool HasLeg() const noexcept;
    /// Neither drives nor turns, and has nothing to do.
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

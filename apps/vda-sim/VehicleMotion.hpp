#pragma once

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
    double acceleration = 0.6;   ///< m/s², to speed up and to brake.
    double maxSpeed = 1.5;       ///< m/s
    double maxTurnSpeed = 1.2;   ///< rad/s
    double cornerSpeed = 0.3;    ///< m/s where the direction changes without a stop.
    double turnTolerance = 0.02; ///< rad: less needs no turning.
};

/// One straight way to a node.
struct MotionLeg
{
    Pose target;                      ///< theta: the heading on the way.
    double maxSpeed = 1.0;            ///< m/s
    double maxTurnSpeed = 1.2;        ///< rad/s
    double exitSpeed = 0.0;           ///< m/s at the target; 0: it stops there.
    bool bTurnBefore = false;         ///< Turn to the heading before driving off, else on the way.
    std::optional<double> finalTheta; ///< Turn to it at the target.
};

/// [-pi, pi]
[[nodiscard]] double NormaliseAngle(double angle);

/// Moves one vehicle in simulated time: with limited acceleration, along one leg at a time, and to a smooth stand at its
/// end. Pure: time comes in as seconds.
class VehicleMotion
{
    MotionLimits _limits;
    Pose _pose;
    std::optional<MotionLeg> _leg;
    double _speed = 0.0;
    double _turnSpeed = 0.0;
    double _driven = 0.0; ///< On this leg.
    bool _bBraking = false;
    bool _bAtTarget = false; ///< There, and turning to finalTheta.

public:
    VehicleMotion(const MotionLimits& limits, const Pose& pose);

    /// Goes on from where it is, at the speed that it has.
    void Begin(const MotionLeg& leg);
    /// Changes the speed at the end of the leg under way.
    void SetExitSpeed(double exitSpeed);
    /// Comes to a stand on the way.
    void Brake();
    /// Drives on after Brake.
    void Resume();
    /// Forgets the leg; only while it stands.
    void Abandon();

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
    [[nodiscard]] bool IsBraking() const noexcept;
    /// Neither drives nor turns, and has nothing to do.
    [[nodiscard]] bool IsStanding() const noexcept;

private:
    [[nodiscard]] bool TryTurn(double theta, double seconds);
    [[nodiscard]] double GetRemaining() const;
    [[nodiscard]] double GetDirection() const;
    void Drive(double seconds);
};

} // namespace ACS::VdaSim

#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/AxisLimits.hpp"
#include <acs/core/BoundedQueue.hpp>
#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>

namespace ACS::OpenStreamSim
{

/// Capacity of the trajectory buffer, in points.
inline constexpr std::size_t TRAJECTORY_CAPACITY = 2048;

/// A target and the time from the previous point to it.
struct TrajectoryPoint
{
    JointVector position{};    ///< deg
    Core::Duration duration{}; ///< Simulated, above 0.
};

/// Agility of joint_traject_init: how closely the arm follows.
struct TrajectoryAgility
{
    bool bOn = false;
    double frequency = 20.0; ///< Hz, 0 to 500. The arm follows like a filter of this bandwidth; 0: as without agility.

    bool operator==(const TrajectoryAgility&) const = default;
};

/// The trajectory buffer and the arm that follows it. The commanded position moves from point to point in straight lines of
/// the axes, each in its time; the arm follows with a first-order lag. When the buffer is empty it stays at the last point.
/// The arm's position at a time does not depend on how often TryAdvance is called. Pure; times are simulated.
class TrajectoryFollower
{
    enum class EPhase : std::uint8_t
    {
        Resting,   ///< Stays at the last point, or has never moved.
        Buffering, ///< Waits for enough points.
        Moving,
        Stopped, ///< Is stopped; the remaining points are in the buffer.
    };

    Core::BoundedQueue<TrajectoryPoint> _points{TRAJECTORY_CAPACITY};
    TrajectoryAgility _agility;
    EPhase _phase = EPhase::Resting;
    JointVector _command = HOME;  ///< Beginning of the current line.
    JointVector _position = HOME; ///< Of the arm, at _since.
    Core::Duration _since{};
    Core::Duration _startAt{};    ///< While buffering: the latest start.
    Core::Duration _buffered{};   ///< Total duration of the points.
    Core::Duration _cleanUntil{}; ///< With agility.
    double _newestTime = 0.0;     ///< time_from_start of the newest point, s.

public:
    /// The arm rests here, and the buffer is empty.
    void Begin(const JointVector& position, Core::Duration now);
    void SetAgility(const TrajectoryAgility& agility);

    /// There must be room. The motion starts when the buffered points last for the look-ahead time, or when the first of
    /// them has waited for that time.
    void Append(const TrajectoryPoint& point, double timeFromStart, Core::Duration lookAhead, Core::Duration now);

    /// False if a line is too fast for an axis: the arm has stopped, and the points are still in the buffer.
    [[nodiscard]] bool TryAdvance(Core::Duration now);

    /// The arm stops at its position; the points stay until Begin.
    void Stop(Core::Duration now);

    /// Drops the points; the arm settles at the current command.
    void Finish(Core::Duration now);

    /// Position and velocity; no effort.
    [[nodiscard]] JointStates GetStates(Core::Duration now) const;

    /// The commanded position, or the one at which the arm stays.
    [[nodiscard]] const JointVector& GetHeld() const noexcept;

    [[nodiscard]] const TrajectoryAgility& GetAgility() const noexcept;
    [[nodiscard]] std::size_t GetFree() const noexcept;
    [[nodiscard]] double GetNewestTime() const noexcept;

    /// No points wait and the arm does not move: the next point begins a trajectory.
    [[nodiscard]] bool IsResting() const noexcept;
    /// The buffer has points of a stopped trajectory.
    [[nodiscard]] bool IsBlocked() const noexcept;
    /// Moves, is about to, has not settled, or, with agility, cleans up.
    [[nodiscard]] bool IsActive(Core::Duration now) const;

private:
    [[nodiscard]] double GetLagSeconds() const noexcept;
    [[nodiscard]] JointVector GetRates() const;
    [[nodiscard]] JointVector GetCommand(Core::Duration now) const;
    void Hold(Core::Duration now, const JointVector& command);
    void Rest(Core::Duration now);
    [[nodiscard]] bool CanReachFront() const;
};

} // namespace ACS::OpenStreamSim

#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/AxisLimits.hpp"
#include <acs/core/BoundedQueue.hpp>
#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>

namespace ACS::OpenStreamSim
{

/// Points that the trajectory buffer holds.
inline constexpr std::size_t TRAJECTORY_CAPACITY = 2048;

/// Where the arm is to be so long after the point before.
struct TrajectoryPoint
{
    JointVector position{};    ///< deg
    Core::Duration duration{}; ///< Simulated, above 0.
};

/// How joint_traject_init wants the arm to follow.
struct TrajectoryAgility
{
    bool bOn = false;
    double frequency =
        20.0; ///< Hz, 0 to 500. The arm follows as fast as a filter of this bandwidth; 0 as without agility.

    bool operator==(const TrajectoryAgility&) const = default;
};

/// The trajectory buffer and the arm that follows it: the commanded position goes from point to point in straight lines of
/// the axes, each in its time, and the arm behind it with a lag of first order. When the buffer is empty it holds the last
/// point. Where the arm is at a time does not depend on how often it was asked. Pure; times are simulated.
class TrajectoryFollower
{
    enum class EPhase : std::uint8_t
    {
        Resting,   ///< Holds, or has never moved.
        Gathering, ///< Holds until there are enough points.
        Moving,
        Stopped, ///< Stands; the points of what was stopped are still there.
    };

    Core::BoundedQueue<TrajectoryPoint> _points{TRAJECTORY_CAPACITY};
    TrajectoryAgility _agility;
    EPhase _phase = EPhase::Resting;
    JointVector _command = HOME;  ///< Where the present line begins.
    JointVector _position = HOME; ///< Of the arm, at _since.
    Core::Duration _since{};
    Core::Duration _startAt{};    ///< While gathering: at the latest.
    Core::Duration _buffered{};   ///< What the points take together.
    Core::Duration _cleanUntil{}; ///< With agility.
    double _newestTime = 0.0;     ///< time_from_start of the newest point, s.

public:
    /// The arm rests here, and the buffer is empty.
    void Begin(const JointVector& position, Core::Duration now);
    void SetAgility(const TrajectoryAgility& agility);

    /// There must be room. The motion starts when the points take as long as the look-ahead, or when the first of them has
    /// waited so long.
    void Append(const TrajectoryPoint& point, double timeFromStart, Core::Duration lookAhead, Core::Duration now);

    /// False where an axis would have to go faster than it can: the arm stopped there, the points are still there.
    [[nodiscard]] bool TryAdvance(Core::Duration now);

    /// The arm stands where it is; the points stay until Begin.
    void Stop(Core::Duration now);

    /// The points are dropped; the arm settles where it was to be now.
    void Finish(Core::Duration now);

    /// Position and velocity; no effort.
    [[nodiscard]] JointStates GetStates(Core::Duration now) const;

    /// Where it is to be, or will hold.
    [[nodiscard]] const JointVector& GetHeld() const noexcept;

    [[nodiscard]] const TrajectoryAgility& GetAgility() const noexcept;
    [[nodiscard]] std::size_t GetFree() const noexcept;
    [[nodiscard]] double GetNewestTime() const noexcept;

    /// Nothing waits and nothing moves: the next point begins a trajectory.
    [[nodiscard]] bool IsResting() const noexcept;
    /// Points of a stopped trajectory are in the way.
    [[nodiscard]] bool IsBlocked() const noexcept;
    /// Moves, is about to, has not settled yet, or, with agility, cleans up.
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

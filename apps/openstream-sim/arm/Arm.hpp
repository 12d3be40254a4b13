#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/PointMotion.hpp"
#include "arm/TrajectoryFollower.hpp"
#include <acs/core/Now.hpp>

#include <cstdint>

namespace ACS::OpenStreamSim
{

/// Progress of the program, which determines the arm's motion.
struct ProgramProgress
{
    Core::Duration elapsed{};
    bool bRunning = false;
};

/// The arm and what moves it: a program, a single move or a trajectory; each begins at the arm's position. Times are
/// simulated. Call EndProgram when a program is abandoned, before another motion begins.
class Arm
{
    enum class EDriver : std::uint8_t
    {
        Program, ///< Or at rest.
        Move,
        Trajectory,
    };

    EDriver _driver = EDriver::Program;
    ArmMotion _program;
    PointMotion _move;
    TrajectoryFollower _trajectory;

public:
    void BeginProgram(Core::Duration duration, Core::Duration now);
    void EndProgram(Core::Duration elapsed);

    /// Moves to the target in this time, or as fast as the axes can if that takes longer.
    void BeginMove(const JointVector& target, double seconds, Core::Duration now);
    [[nodiscard]] bool IsMoving(Core::Duration now) const;
    [[nodiscard]] Core::Duration GetMoveEnd() const noexcept;

    /// Lets the trajectory move the arm, with an empty buffer.
    void BeginTrajectory(Core::Duration now);
    /// Stops the arm if a trajectory moves it, and empties the buffer.
    void ClearTrajectory(Core::Duration now);
    /// When no trajectory moves the arm it may still have points: those that a stop left in the buffer.
    [[nodiscard]] TrajectoryFollower& GetTrajectory() noexcept;
    [[nodiscard]] const TrajectoryFollower& GetTrajectory() const noexcept;
    [[nodiscard]] bool IsFollowing() const noexcept;

    /// False if a trajectory was too fast for an axis, which stopped the arm.
    [[nodiscard]] bool TryAdvance(Core::Duration now);

    /// Ends a move or a trajectory at the arm's position; a program is not affected.
    void Stop(Core::Duration now);

    [[nodiscard]] JointStates GetStates(Core::Duration now, const ProgramProgress& progress) const;

private:
    /// Position and velocity.
    [[nodiscard]] JointStates GetMotion(Core::Duration now, const ProgramProgress& progress) const;
};

} // namespace ACS::OpenStreamSim

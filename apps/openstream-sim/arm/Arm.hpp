#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/PointMotion.hpp"
#include "arm/TrajectoryFollower.hpp"
#include <acs/core/Now.hpp>

#include <cstdint>

namespace ACS::OpenStreamSim
{

/// How far the running program is, as the arm's motion depends on it.
struct ProgramProgress
{
    Core::Duration elapsed{};
    bool bRunning = false;
};

/// The arm and what moves it: a program, a single move, or a trajectory; each takes over where the one before has left it.
/// Times are simulated. Whoever gives a program up calls EndProgram before anything else moves the arm.
class Arm
{
    enum class EDriver : std::uint8_t
    {
        Program, ///< Or nothing.
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

    /// To the target in so many seconds, or as fast as the axes can.
    void BeginMove(const JointVector& target, double seconds, Core::Duration now);
    [[nodiscard]] bool IsMoving(Core::Duration now) const;
    [[nodiscard]] Core::Duration GetMoveEnd() const noexcept;

    /// The trajectory takes the arm over, with an empty buffer.
    void BeginTrajectory(Core::Duration now);
    /// The arm stands where it is if a trajectory had it, and the buffer is empty.
    void ClearTrajectory(Core::Duration now);
    /// What there is of it when something else, or nothing, has the arm: what a stop left in the buffer.
    [[nodiscard]] TrajectoryFollower& GetTrajectory() noexcept;
    [[nodiscard]] const TrajectoryFollower& GetTrajectory() const noexcept;
    [[nodiscard]] bool IsFollowing() const noexcept;

    /// False where a trajectory would have been too fast for an axis, which stopped the arm.
    [[nodiscard]] bool TryAdvance(Core::Duration now);

    /// A move or a trajectory ends where the arm is; a program is not touched.
    void Stop(Core::Duration now);

    [[nodiscard]] JointStates GetStates(Core::Duration now, const ProgramProgress& progress) const;

private:
    /// Position and velocity.
    [[nodiscard]] JointStates GetMotion(Core::Duration now, const ProgramProgress& progress) const;
};

} // namespace ACS::OpenStreamSim

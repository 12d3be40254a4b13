#pragma once

#include <acs/core/Now.hpp>

#include <array>
#include <cstddef>

namespace ACS::OpenStreamSim
{

inline constexpr std::size_t AXES = 6;

using JointVector = std::array<double, AXES>;

/// Where the arm stands when nothing has moved it, in degrees.
inline constexpr JointVector HOME{0.0, 90.0, 0.0, 0.0, 0.0, 0.0};

struct JointStates
{
    JointVector position{}; ///< deg
    JointVector velocity{}; ///< deg/s, simulated
    JointVector effort{};   ///< Nm
};

/// What the arm does while a program runs: it swings, begins and ends at rest, and ends at home. Always the same for the
/// same program; continuous whatever was stopped or given up before.
class ArmMotion
{
    JointVector _from = HOME;
    double _seconds = 0.0; ///< Of the whole motion; 0 where it rests.

public:
    /// From where it rests.
    void Begin(Core::Duration duration);

    /// The motion ends or is given up so long after its beginning: the arm stays where it is.
    void End(Core::Duration elapsed);

    /// So long after the beginning. The velocity is that of a motion that goes on; a halted arm has none.
    [[nodiscard]] JointStates GetStates(Core::Duration elapsed, bool bMoving) const;
};

} // namespace ACS::OpenStreamSim

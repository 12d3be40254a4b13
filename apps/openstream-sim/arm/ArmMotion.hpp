#pragma once

#include "arm/AxisLimits.hpp"
#include <acs/core/Now.hpp>

namespace ACS::OpenStreamSim
{

struct JointStates
{
    JointVector position{}; ///< deg
    JointVector velocity{}; ///< deg/s, simulated
    JointVector effort{};   ///< Nm
};

/// Effort of a stationary arm: gravity on the axes that lift.
[[nodiscard]] JointVector ComputeEffort(const JointVector& position);

/// Motion of the arm while a program runs: it swings, begins and ends at rest, and ends at home, or as near to home as the
/// axes' speed allows. It is the same each time a program runs, and begins at the arm's position.
class ArmMotion
{
    JointVector _from = HOME;
    JointVector _toHome{}; ///< deg
    double _seconds = 0.0; ///< Of the whole motion; 0 at rest.

public:
    /// Puts the arm at rest at this position.
    void Place(const JointVector& position);

    /// Begins at the position of rest.
    void Begin(Core::Duration duration);

    /// The motion ends or is abandoned at this time after its beginning: the arm stays there.
    void End(Core::Duration elapsed);

    /// The states at this time after the beginning; the velocity is 0 if the arm is halted.
    [[nodiscard]] JointStates GetStates(Core::Duration elapsed, bool bMoving) const;
};

} // namespace ACS::OpenStreamSim

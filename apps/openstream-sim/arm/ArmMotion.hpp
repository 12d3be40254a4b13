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

/// Of an arm that stands there: gravity's on the axes that lift.
[[nodiscard]] JointVector ComputeEffort(const JointVector& position);

/// What the arm does while a program runs: it swings, begins and ends at rest, and ends at home, or as far on its way there
/// as the axes' speed lets it come. Always the same for the same program; continuous whatever was before.
class ArmMotion
{
    JointVector _from = HOME;
    JointVector _toHome{}; ///< deg
    double _seconds = 0.0; ///< Of the whole motion; 0 where it rests.

public:
    /// Rests there.
    void Place(const JointVector& position);

    /// From where it rests.
    void Begin(Core::Duration duration);

    /// The motion ends or is given up so long after its beginning: the arm stays where it is.
    void End(Core::Duration elapsed);

    /// So long after the beginning. The velocity is that of a motion that goes on; a halted arm has none.
    [[nodiscard]] JointStates GetStates(Core::Duration elapsed, bool bMoving) const;
};

} // namespace ACS::OpenStreamSim

#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/AxisLimits.hpp"
#include <acs/core/Now.hpp>

namespace ACS::OpenStreamSim
{

/// Moves all axes smoothly from one position to another in the same time, within their limits. Times are simulated.
class PointMotion
{
    JointVector _from = HOME;
    JointVector _to = HOME;
    Core::Duration _begunAt{};
    double _seconds = 0.0;

public:
    /// Takes this time, or the shortest time that the axes allow if that is longer.
    void Begin(const JointVector& from, const JointVector& to, double seconds, Core::Duration now);

    [[nodiscard]] Core::Duration GetEnd() const noexcept;

    /// Position and velocity; no effort.
    [[nodiscard]] JointStates GetStates(Core::Duration now) const;

    /// The shortest time that the axes allow, in seconds.
    [[nodiscard]] static double GetShortestSeconds(const JointVector& from, const JointVector& to);
};

} // namespace ACS::OpenStreamSim

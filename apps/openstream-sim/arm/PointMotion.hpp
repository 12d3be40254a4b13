#pragma once

#include "arm/ArmMotion.hpp"
#include "arm/AxisLimits.hpp"
#include <acs/core/Now.hpp>

namespace ACS::OpenStreamSim
{

/// All axes from one position to another in the same time, smoothly, and none faster than it can. Times are simulated.
class PointMotion
{
    JointVector _from = HOME;
    JointVector _to = HOME;
    Core::Duration _begunAt{};
    double _seconds = 0.0;

public:
    /// In so many seconds, or in the shortest time that the axes allow where that is longer.
    void Begin(const JointVector& from, const JointVector& to, double seconds, Core::Duration now);

    [[nodiscard]] Core::Duration GetEnd() const noexcept;

    /// Position and velocity; no effort.
    [[nodiscard]] JointStates GetStates(Core::Duration now) const;

    /// The shortest time that the axes allow, in seconds.
    [[nodiscard]] static double GetShortestSeconds(const JointVector& from, const JointVector& to);
};

} // namespace ACS::OpenStreamSim

#include "robot/ValidState.hpp"

#include <algorithm>
#include <cmath>

namespace ACS::Planning
{

StateChanged MakeValidState(StateChanged state, const std::optional<StateChanged>& beforeOrNull)
{
    if (!std::isfinite(state.x) || !std::isfinite(state.y) || !std::isfinite(state.theta))
    {
        state.x = 0;
        state.y = 0;
        state.theta = 0;
        state.bPoseKnown = false;
    }
    if (!std::isfinite(state.batteryPercent))
    {
        state.batteryPercent = beforeOrNull.has_value() ? beforeOrNull->batteryPercent : 0;
    }
    state.batteryPercent = std::clamp(state.batteryPercent, 0.0, 100.0);
    return state;
}

} // namespace ACS::Planning

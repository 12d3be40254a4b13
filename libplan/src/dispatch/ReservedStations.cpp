#include "dispatch/ReservedStations.hpp"

#include <algorithm>

namespace ACS::Planning
{

void ReservedStations::Add(const ActivePlan& plan)
{
    for (const ResolvedStep& step : plan.resolved.steps)
    {
        _stationIDs.insert(step.stationID);
    }
}

bool ReservedStations::IsAnyOf(const ActivePlan& plan) const
{
    return std::ranges::any_of(plan.resolved.steps, [this](const ResolvedStep& step) {
        return _stationIDs.contains(step.stationID);
    });
}

} // namespace ACS::Planning

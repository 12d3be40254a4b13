#pragma once

#include "plan/ActivePlan.hpp"

#include <string_view>
#include <unordered_set>

namespace ACS::Planning
{

/// The stations of plans that do not begin now. A plan after them that uses one of these does not begin either, so that the queue's
/// order remains at each station.
class ReservedStations
{
    std::unordered_set<std::string_view> _stationIDs; ///< Of the plans, which outlive them.

public:
    void Add(const ActivePlan& plan);
    /// Whether the plan uses one of them.
    [[nodiscard]] bool IsAnyOf(const ActivePlan& plan) const;
};

} // namespace ACS::Planning

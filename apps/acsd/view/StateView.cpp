#include "view/StateView.hpp"

#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace ACS::Acsd
{

namespace
{

/// Those of `after` that are new or differ from the one of the same ID.
template <typename TItem>
std::vector<TItem> FindChanged(
    const std::vector<TItem>& before,
    const std::vector<TItem>& after,
    std::string TItem::*itemID)
{
    std::unordered_map<std::string_view, const TItem*> former;
    for (const TItem& item : before)
    {
        former.emplace(item.*itemID, &item);
    }
    std::vector<TItem> changed;
    for (const TItem& item : after)
    {
        const auto found = former.find(item.*itemID);
        if (found == former.end() || *found->second != item)
        {
            changed.push_back(item);
        }
    }
    return changed;
}

} // namespace

bool StateChanges::IsEmpty() const noexcept
{
    return !status.has_value() && plans.empty() && endedPlanIDs.empty() && robots.empty() && !alarms.has_value();
}

StateChanges FindChanges(const StateView& before, const StateView& after)
{
    StateChanges changes;
    if (before.status != after.status)
    {
        changes.status = after.status;
    }
    changes.plans = FindChanged(before.plans, after.plans, &PlanView::planID);
    changes.robots = FindChanged(before.robots, after.robots, &RobotView::robotID);
    if (before.alarms != after.alarms)
    {
        changes.alarms = after.alarms;
    }
    std::unordered_set<std::string_view> unfinished;
    for (const PlanView& plan : after.plans)
    {
        unfinished.insert(plan.planID);
    }
    for (const PlanView& plan : before.plans)
    {
        if (!unfinished.contains(plan.planID))
        {
            changes.endedPlanIDs.push_back(plan.planID);
        }
    }
    return changes;
}

} // namespace ACS::Acsd

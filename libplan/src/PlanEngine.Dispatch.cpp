#include "PlanEngine.Impl.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ACS::Planning
{

void PlanEngine::Impl::Dispatch()
{
    // What one part frees or ends may be what an earlier part waited for.
    while (std::exchange(_bDispatchNeeded, false))
    {
        if (_tscState == ETscState::Auto)
        {
            AssignPlans();
        }
        MoveWaiting();
        if (CanDriveHome())
        {
            SendIdleHome();
        }
        PartStuck();
    }
}

void PlanEngine::Impl::AssignPlans()
{
    std::vector<ActivePlan*> queue;
    for (const auto& [key, plan] : _pending)
    {
        queue.push_back(plan);
    }
    for (ActivePlan* plan : queue)
    {
        const bool bAnyIdle = std::ranges::any_of(_robots, [](const Robot& robot) {
            return robot.planOrNull == nullptr && !robot.drive.has_value() && IsUsable(robot);
        });
        if (!bAnyIdle)
        {
            return;
        }
        if (Robot* robotOrNull = FindNearestOrNull(*plan); robotOrNull != nullptr)
        {
            BeginPlan(*plan, *robotOrNull);
        }
    }
}

PlanEngine::Impl::Robot* PlanEngine::Impl::FindNearestOrNull(const ActivePlan& plan)
{
    std::vector<Robot*> idle;
    for (const std::size_t index : plan.resolved.candidates)
    {
        Robot& robot = _robots[index];
        if (robot.planOrNull == nullptr && !robot.drive.has_value() && IsUsable(robot))
        {
            idle.push_back(&robot);
        }
    }
    if (idle.size() < 2)
    {
        return idle.empty() ? nullptr : idle.front();
    }
    // One search for each vehicle type, however many robots of it there are.
    std::map<std::string_view, std::vector<std::size_t>> starts;
    for (const Robot* robot : idle)
    {
        starts[robot->options->vehicleTypeID].push_back(*robot->node);
    }
    std::optional<QuickestStart> quickest;
    for (const auto& [vehicleTypeID, nodes] : starts)
    {
        const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
        const std::optional<QuickestStart> start = _router.FindQuickestStartOrNull(vehicleTypeID, nodes, dock);
        if (start.has_value() && (!quickest.has_value() || start->travelSeconds < quickest->travelSeconds))
        {
            quickest = start;
        }
    }
    const auto nearest = std::ranges::find_if(idle, [&quickest](const Robot* robot) {
        return quickest.has_value() && robot->node == quickest->nodeIndex;
    });
    return nearest == idle.end() ? idle.front() : *nearest;
}

} // namespace ACS::Planning

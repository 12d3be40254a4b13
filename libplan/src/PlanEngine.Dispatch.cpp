#include "PlanEngine.Impl.hpp"

#include <algorithm>
#include <limits>
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
        PartCircles();
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
    Robot* nearest = idle.front();
    double shortest = std::numeric_limits<double>::infinity();
    for (Robot* robot : idle)
    {
        const std::string& vehicleTypeID = robot->options->vehicleTypeID;
        const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
        const std::optional<Route> route = _router.FindRouteOrNull(
            vehicleTypeID,
            _site.GetNodes()[*robot->node].nodeID,
            _site.GetNodes()[dock].nodeID);
        if (route.has_value() && route->travelSeconds < shortest)
        {
            shortest = route->travelSeconds;
            nearest = robot;
        }
    }
    return nearest;
}

} // namespace ACS::Planning

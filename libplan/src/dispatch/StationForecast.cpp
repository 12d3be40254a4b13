#include "dispatch/StationForecast.hpp"

#include <algorithm>

namespace ACS::Planning
{

namespace
{

/// Between two robots at a station: they wait for others on their way.
constexpr double MARGIN_SECONDS = 30;

template <typename TVisitor>
bool IsAnyStep(const ActivePlan& plan, TVisitor visitor)
{
    const std::vector<ResolvedStep>& steps = plan.resolved.steps;
    const std::size_t end = std::min(steps.size(), plan.step + VisitForecast::STEPS);
    for (std::size_t i = plan.step; i < end; ++i)
    {
        if (visitor(i))
        {
            return true;
        }
    }
    return false;
}

} // namespace

StationForecast::StationForecast(const Fleet& fleet, const VisitForecast& visits)
    : _fleet(fleet),
      _visits(visits)
{
    for (const Robot& robot : fleet)
    {
        if (robot.planOrNull != nullptr)
        {
            Add(*robot.planOrNull, robot);
        }
    }
}

void StationForecast::Add(const ActivePlan& plan, const Robot& robot)
{
    static_cast<void>(IsAnyStep(plan, [this, &plan, &robot](std::size_t step) {
        std::vector<std::size_t>& robots = _robots[plan.resolved.steps[step].stationID];
        if (std::ranges::count(robots, robot.index) == 0)
        {
            robots.push_back(robot.index);
        }
        return false;
    }));
}

void StationForecast::PassOver(const ActivePlan& plan)
{
    _reserved.Add(plan);
}

std::vector<std::size_t> StationForecast::ListRobots(std::string_view stationID) const
{
    const auto found = _robots.find(stationID);
    return found == _robots.end() ? std::vector<std::size_t>() : found->second;
}

std::optional<std::string_view> StationForecast::FindTakenOrNull(const ActivePlan& plan) const
{
    std::optional<std::string_view> taken;
    static_cast<void>(IsAnyStep(plan, [this, &plan, &taken](std::size_t step) {
        const std::string_view stationID = plan.resolved.steps[step].stationID;
        taken = _robots.contains(stationID) ? std::optional(stationID) : std::nullopt;
        return taken.has_value();
    }));
    return taken;
}

bool StationForecast::IsReserved(const ActivePlan& plan) const
{
    return _reserved.IsAnyOf(plan);
}

bool StationForecast::CanBegin(const ActivePlan& plan, const Robot& robot) const
{
    const bool bReserved = IsReserved(plan);
    if (bReserved || !FindTakenOrNull(plan).has_value())
    {
        return !bReserved;
    }
    const std::vector<Visit> visits = _visits.ListVisits(robot, plan);
    for (std::size_t i = 0; i < visits.size(); ++i)
    {
        const std::string_view stationID = plan.resolved.steps[plan.step + i].stationID;
        const std::vector<std::size_t> others = ListRobots(stationID);
        if (std::ranges::any_of(others, [this, stationID, &visit = visits[i]](std::size_t other) {
                return IsExpected(_fleet[other], stationID, visit);
            }))
        {
            return false;
        }
    }
    return true;
}

bool StationForecast::IsExpected(const Robot& robot, std::string_view stationID, const Visit& visit) const
{
    const ActivePlan& plan = *robot.planOrNull;
    const std::vector<Visit> visits = _visits.ListVisits(robot, plan);
    return IsAnyStep(plan, [&plan, &visits, &visit, stationID](std::size_t step) {
        const std::size_t index = step - plan.step;
        return index < visits.size() && plan.resolved.steps[step].stationID == stationID
            && visit.departure + MARGIN_SECONDS > visits[index].arrival
            && visit.arrival < visits[index].departure + MARGIN_SECONDS;
    });
}

} // namespace ACS::Planning

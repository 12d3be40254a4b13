#include "traffic/VisitForecast.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <optional>

namespace ACS::Planning
{

namespace
{

constexpr double NO_DEPARTURE = std::numeric_limits<double>::infinity();

} // namespace

VisitForecast::VisitForecast(const EngineState& engine, const RoutePlanner& routes)
    : _admission(engine.admission),
      _jobTimes(engine.jobTimes),
      _transaction(engine.transaction),
      _routes(routes)
{
}

double VisitForecast::GetTravelSeconds(const Robot& robot, std::size_t from, std::size_t to) const
{
    const std::array start{from};
    const std::optional<QuickestStart> way =
        _routes.GetOpenRouter().FindQuickestStartOrNull(robot.options->vehicleTypeID, ELoad::Unknown, start, to);
    return way.has_value() ? way->travelSeconds : 0;
}

double VisitForecast::GetJobSeconds(const ActivePlan& plan, std::size_t step) const
{
    const ResolvedStep& resolved = plan.resolved.steps[step];
    const std::size_t count = std::max<std::size_t>(resolved.jobs.size(), 1) - (step == plan.step ? plan.job : 0);
    const double seconds = static_cast<double>(count) * _jobTimes.GetSeconds(resolved.stationID);
    if (step != plan.step || !plan.jobClock.begunAt.has_value())
    {
        return seconds;
    }
    const std::chrono::duration<double> worked = _transaction.GetNow().steady - *plan.jobClock.begunAt;
    return std::max(0.0, seconds - worked.count());
}

std::vector<Visit> VisitForecast::ListVisits(const Robot& robot, const ActivePlan& plan) const
{
    constexpr double WAITING_SECONDS = 10; ///< Assumed of a robot that cannot begin its drive yet.
    std::vector<Visit> visits;
    const std::vector<ResolvedStep>& steps = plan.resolved.steps;
    std::optional<std::size_t> from = robot.place.node;
    double time = 0;
    for (std::size_t i = plan.step; i < std::min(steps.size(), plan.step + STEPS) && from.has_value(); ++i)
    {
        const std::optional<std::size_t> dock =
            _admission.FindDockOrNull(steps[i].stationID, robot.options->vehicleTypeID);
        if (!dock.has_value())
        {
            break;
        }
        const bool bWaits = robot.planOrNull == &plan && i == plan.step && robot.activity == EActivity::Waits
            && !robot.drive.has_value() && from != dock;
        Visit& visit = visits.emplace_back();
        if (!robot.IsUsable())
        {
            visit = {0, NO_DEPARTURE}; // taken until it can move
            continue;
        }
        visit.arrival = time + GetTravelSeconds(robot, *from, *dock) + (bWaits ? WAITING_SECONDS : 0);
        visit.departure = visit.arrival + GetJobSeconds(plan, i);
        time = visit.departure;
        from = dock;
    }
    return visits;
}

double VisitForecast::GetDeparture(const Robot& robot, std::size_t dock) const
{
    const bool bLeaves = robot.drive.has_value() && robot.drive->nodes.back() != dock;
    if (!robot.IsUsable() || robot.planOrNull == nullptr)
    {
        return robot.IsUsable() && bLeaves ? 0 : NO_DEPARTURE;
    }
    const ActivePlan& plan = *robot.planOrNull;
    const std::vector<Visit> visits = ListVisits(robot, plan);
    std::optional<double> departure;
    for (std::size_t i = 0; i < visits.size(); ++i)
    {
        const ResolvedStep& step = plan.resolved.steps[plan.step + i];
        if (_admission.FindDockOrNull(step.stationID, robot.options->vehicleTypeID) == dock)
        {
            departure = visits[i].departure;
        }
    }
    return departure.value_or(bLeaves ? 0 : NO_DEPARTURE);
}

} // namespace ACS::Planning

#include "dispatch/QueuePass.hpp"

#include <algorithm>

namespace ACS::Planning
{

namespace
{

// They limit the time of a pass.
constexpr std::size_t MOST_SEARCHES = 1'000; // for routes
constexpr std::size_t MOST_TAKEN = 16;       // plans whose station is taken and for which a robot is looked for
constexpr std::size_t MOST_COMPARED = 16;    // plans that may overtake one

} // namespace

QueuePass::QueuePass(const EngineState& engine, const VisitForecast& visits, Dispatcher& dispatcher, FreeRobots& free)
    : _plans(engine.plans),
      _options(engine.options),
      _dispatcher(dispatcher),
      _free(free),
      _stations(engine.fleet, visits)
{
    _dispatcher.ForgetKeptRobots();
}

std::optional<QueuePass::Choice> QueuePass::FindNextOrNull()
{
    while (!_free.IsEmpty() && _searches < MOST_SEARCHES)
    {
        ActivePlan* const firstOrNull = _plans.FindNextStoredOrNull(_lastOrNull);
        if (firstOrNull == nullptr)
        {
            break;
        }
        Robot* const robotOrNull = FindRobotOrNull(*firstOrNull);
        if (robotOrNull == nullptr)
        {
            _lastOrNull = firstOrNull;
            continue;
        }
        ActivePlan& plan = ChoosePlan(*firstOrNull, *robotOrNull);
        if (&plan == firstOrNull)
        {
            _lastOrNull = firstOrNull;
        }
        _free.Remove(*robotOrNull);
        _stations.Add(plan, *robotOrNull);
        return Choice{plan, *robotOrNull};
    }
    return std::nullopt;
}

Robot* QueuePass::FindRobotOrNull(ActivePlan& plan)
{
    const bool bTaken = _stations.FindTakenOrNull(plan).has_value();
    if (_stations.IsReserved(plan) || (bTaken && _taken == MOST_TAKEN))
    {
        _stations.PassOver(plan);
        return nullptr;
    }
    KeepRobots(plan);
    const std::vector<Robot*>& robots = _free.List(plan.resolved.candidates);
    if (!_dispatcher.IsPromising(plan, robots))
    {
        return nullptr;
    }
    ++_searches;
    Robot* const robotOrNull = _dispatcher.FindNearestOrNull(plan, robots);
    if (robotOrNull == nullptr || _stations.CanBegin(plan, *robotOrNull))
    {
        return robotOrNull;
    }
    _stations.PassOver(plan);
    _passedOver.emplace_back(&plan, robotOrNull);
    ++_taken;
    return nullptr;
}

void QueuePass::KeepRobots(const ActivePlan& plan)
{
    std::erase_if(_passedOver, [this, &plan](const auto& before) {
        const bool bKept = GetPriority(*before.first) != GetPriority(plan);
        if (bKept)
        {
            _free.Remove(*before.second);
            _dispatcher.KeepRobot(*before.second, *before.first);
        }
        return bKept;
    });
}

ActivePlan& QueuePass::ChoosePlan(ActivePlan& first, const Robot& robot)
{
    const std::optional<double> ofFirst =
        _options.queueOvertaking.count() > 0 ? _dispatcher.GetTravelSecondsOrNull(first, robot) : std::nullopt;
    if (!ofFirst.has_value())
    {
        return first;
    }
    double shortest = *ofFirst;
    ActivePlan* chosen = &first;
    ReservedStations before;
    before.Add(first);
    ActivePlan* planOrNull = _plans.FindNextStoredOrNull(&first);
    for (std::size_t i = 0; i < MOST_COMPARED && planOrNull != nullptr && CanOvertake(*planOrNull, first); ++i)
    {
        ActivePlan& plan = *planOrNull;
        const std::optional<double> seconds =
            before.IsAnyOf(plan) ? std::nullopt : _dispatcher.GetTravelSecondsOrNull(plan, robot);
        if (seconds.has_value() && *seconds < shortest && IsBestWith(plan, robot))
        {
            chosen = &plan;
            shortest = *seconds;
        }
        before.Add(plan);
        planOrNull = _plans.FindNextStoredOrNull(&plan);
    }
    return *chosen;
}

bool QueuePass::CanOvertake(const ActivePlan& plan, const ActivePlan& first) const
{
    return GetPriority(plan) == GetPriority(first)
        && plan.record.progress.queuedAt - first.record.progress.queuedAt <= _options.queueOvertaking;
}

bool QueuePass::IsBestWith(ActivePlan& plan, const Robot& robot)
{
    return _stations.CanBegin(plan, robot)
        && _dispatcher.FindNearestOrNull(plan, _free.List(plan.resolved.candidates)) == &robot;
}

std::int32_t QueuePass::GetPriority(const ActivePlan& plan) const
{
    return plan.record.GetPriorityOrNull().value_or(_options.defaultPriority);
}

} // namespace ACS::Planning

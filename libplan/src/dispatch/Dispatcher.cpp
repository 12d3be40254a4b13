#include "dispatch/Dispatcher.hpp"

#include "robot/JobCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace ACS::Planning
{

Dispatcher::Dispatcher(EngineState& engine, const TrafficCoordinator& coordinator)
    : _admission(engine.admission),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _coordinator(coordinator),
      _router(coordinator.GetRouter()),
      _ports(engine)
{
}

Robot* Dispatcher::FindNearestOrNull(const ActivePlan& plan)
{
    std::vector<Robot*> known;
    std::vector<Robot*> supposed;
    for (const std::size_t index : plan.resolved.candidates)
    {
        Robot& robot = _fleet[index];
        const bool bPossible = robot.IsFree() && !plan.rejections.contains(index);
        const PortVerdict verdict = bPossible ? _ports.JudgePorts(plan, robot) : PortVerdict{"", false};
        if (!verdict.unavailabilityOrNull.has_value() && _coordinator.CanServe(robot, plan))
        {
            (verdict.bSupposed ? supposed : known).push_back(&robot);
        }
    }
    const bool bAll = known.size() + supposed.size() == plan.resolved.candidates.size();
    if (bAll && plan.resolved.candidates.size() == 1)
    {
        return &_fleet[plan.resolved.candidates.front()];
    }
    for (const std::vector<Robot*>& robots : {known, supposed})
    {
        if (Robot* quickestOrNull = FindQuickestOrNull(plan, robots); quickestOrNull != nullptr)
        {
            return quickestOrNull;
        }
    }
    // With no robot to wait for, the drive starts anyway and fails because there is no route.
    return bAll ? &_fleet[plan.resolved.candidates.front()] : nullptr;
}

Robot* Dispatcher::FindSuccessorOrNull(ActivePlan& plan)
{
    for (const std::size_t index : plan.resolved.candidates)
    {
        CheckJobs(plan, _fleet[index]); // only pending plans are checked when a factsheet changes
    }
    return FindNearestOrNull(plan);
}

Robot* Dispatcher::FindQuickestOrNull(const ActivePlan& plan, const std::vector<Robot*>& robots) const
{
    // One search per vehicle type and load.
    std::map<std::pair<std::string_view, ELoad>, std::vector<std::size_t>> starts;
    for (const Robot* robot : robots)
    {
        starts[{robot->options->vehicleTypeID, robot->GetLoad()}].push_back(*robot->place.node);
    }
    std::optional<QuickestStart> quickest;
    for (const auto& [key, nodes] : starts)
    {
        const auto& [vehicleTypeID, load] = key;
        const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
        const std::optional<QuickestStart> start =
            _coordinator.GetOpenRouter().FindQuickestStartOrNull(vehicleTypeID, load, nodes, dock);
        if (start.has_value() && (!quickest.has_value() || start->travelSeconds < quickest->travelSeconds))
        {
            quickest = start;
        }
    }
    const auto nearest = std::ranges::find_if(robots, [&quickest](const Robot* robot) {
        return quickest.has_value() && robot->place.node == quickest->nodeIndex;
    });
    return nearest == robots.end() ? nullptr : *nearest;
}

bool Dispatcher::HasWay(const ActivePlan& plan, const Robot& robot) const
{
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    const std::size_t dock = *_admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
    const std::array start{*robot.place.node};
    return _router.FindQuickestStartOrNull(vehicleTypeID, robot.GetLoad(), start, dock).has_value();
}

void Dispatcher::OnJobCheck(Robot& robot, const JobCheckChanged& event)
{
    robot.view.jobCheck = event.jobCheck;
    for (const auto& [planID, plan] : _plans.GetActive())
    {
        if (plan->record.progress.state == EPlanState::Pending)
        {
            CheckJobs(*plan, robot);
        }
    }
    _transaction.RequestDispatch();
}

void Dispatcher::CheckJobs(ActivePlan& plan, const Robot& robot)
{
    plan.rejections.erase(robot.index);
    if (robot.view.jobCheck == nullptr || std::ranges::count(plan.resolved.candidates, robot.index) == 0)
    {
        return;
    }
    for (std::size_t step = 0; step < plan.resolved.steps.size(); ++step)
    {
        const std::size_t count = std::max<std::size_t>(plan.resolved.steps[step].jobs.size(), 1);
        for (std::size_t job = 0; job < count; ++job)
        {
            std::optional<std::string> reason =
                robot.view.jobCheck->GetRejectionReasonOrNull(MakeStartJob(plan, step, job, robot));
            if (reason.has_value())
            {
                plan.rejections.emplace(robot.index, std::move(*reason));
                return;
            }
        }
    }
}

bool Dispatcher::IsRejectedByAll(const ActivePlan& plan) const
{
    return std::ranges::all_of(plan.resolved.candidates, [this, &plan](std::size_t index) {
        return _fleet[index].view.bOnline && plan.rejections.contains(index);
    });
}

std::string Dispatcher::DescribeRejections(const ActivePlan& plan) const
{
    std::string text;
    for (const auto& [index, reason] : plan.rejections)
    {
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", _fleet[index].GetID(), reason);
    }
    return fmt::format("No robot can execute the plan: {}.", text);
}

const PortCheck& Dispatcher::GetPorts() const noexcept
{
    return _ports;
}

} // namespace ACS::Planning

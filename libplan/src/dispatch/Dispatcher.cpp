#include "dispatch/Dispatcher.hpp"

#include "robot/JobCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

namespace ACS::Planning
{

Dispatcher::Dispatcher(EngineState& engine, const TrafficCoordinator& coordinator)
    : _admission(engine.admission),
      _plans(engine.plans),
      _blocks(engine.blocks),
      _fleet(engine.fleet),
      _transaction(engine.transaction),
      _coordinator(coordinator),
      _router(coordinator.GetRouter()),
      _ports(engine)
{
}

Robot* Dispatcher::FindNearestOrNull(ActivePlan& plan)
{
    FreeRobots free(_fleet);
    return FindNearestOrNull(plan, free.List(plan.resolved.candidates));
}

/// The nearest robot is looked for first, because the further checks take more time; mostly it passes them.
Robot* Dispatcher::FindNearestOrNull(ActivePlan& plan, const std::vector<Robot*>& freeRobots)
{
    constexpr std::size_t MOST_TRIED = 4;
    Choice choice;
    std::ranges::copy_if(freeRobots, std::back_inserter(choice.left), [&plan](const Robot* robot) {
        return !HasKnownRejection(plan, *robot);
    });
    choice.bAll = choice.left.size() == plan.resolved.candidates.size();
    if (plan.resolved.candidates.size() == 1)
    {
        const bool bSuitable =
            choice.bAll && HasPorts(plan, *choice.left.front()) && CanExecute(plan, *choice.left.front());
        return bSuitable ? choice.left.front() : nullptr;
    }
    for (std::size_t tried = 0;; ++tried)
    {
        if (tried == MOST_TRIED)
        {
            JudgeAll(plan, choice);
        }
        Robot* const nearestOrNull = FindQuickestOrNull(plan, choice.left);
        if (nearestOrNull == nullptr)
        {
            break;
        }
        std::erase(choice.left, nearestOrNull);
        if (tried < MOST_TRIED && !IsKnownToHaveCarriers(plan, *nearestOrNull, choice))
        {
            continue;
        }
        if (CanExecute(plan, *nearestOrNull))
        {
            return nearestOrNull;
        }
        choice.bAll = false;
    }
    while (!choice.supposed.empty())
    {
        Robot* const nearestOrNull = FindQuickestOrNull(plan, choice.supposed);
        if (nearestOrNull == nullptr)
        {
            break;
        }
        if (CanExecute(plan, *nearestOrNull))
        {
            return nearestOrNull;
        }
        choice.bAll = false;
        std::erase(choice.supposed, nearestOrNull);
    }
    // With no robot to wait for, the drive starts anyway and fails because there is no route.
    const auto isSuitable = [this, &plan](const Robot* robotOrNull) {
        return HasPorts(plan, *robotOrNull) && CanExecute(plan, *robotOrNull);
    };
    choice.bAll =
        choice.bAll && std::ranges::all_of(choice.left, isSuitable) && std::ranges::all_of(choice.supposed, isSuitable);
    return choice.bAll ? &_fleet[plan.resolved.candidates.front()] : nullptr;
}

bool Dispatcher::IsPromising(const ActivePlan& plan, const std::vector<Robot*>& freeRobots) const
{
    std::string_view judgedID; // mostly the free robots of a plan have the same vehicle type
    bool bBlocked = false;
    return std::ranges::any_of(freeRobots, [&](const Robot* robot) {
        if (const std::string_view typeID = robot->options->vehicleTypeID; typeID != judgedID)
        {
            judgedID = typeID;
            bBlocked = IsBlocked(plan, typeID);
        }
        return !bBlocked && !HasKnownRejection(plan, *robot);
    });
}

bool Dispatcher::IsBlocked(const ActivePlan& plan, std::string_view vehicleTypeID) const
{
    return !_blocks.IsEmpty()
        && std::ranges::any_of(plan.resolved.steps, [this, vehicleTypeID](const ResolvedStep& step) {
               const std::optional<std::size_t> dock = _admission.FindDockOrNull(step.stationID, vehicleTypeID);
               return dock.has_value() && _blocks.FindOfTargetOrNull(step.stationID, *dock) != nullptr;
           });
}

bool Dispatcher::IsKnownToHaveCarriers(const ActivePlan& plan, Robot& robot, Choice& choice) const
{
    const PortVerdict verdict = _ports.JudgePorts(plan, robot);
    if (verdict.unavailabilityOrNull.has_value())
    {
        choice.bAll = false;
    }
    else if (verdict.bSupposed)
    {
        choice.supposed.push_back(&robot);
    }
    return !verdict.unavailabilityOrNull.has_value() && !verdict.bSupposed;
}

void Dispatcher::JudgeAll(const ActivePlan& plan, Choice& choice) const
{
    std::erase_if(choice.left, [this, &plan, &choice](Robot* robot) {
        return !IsKnownToHaveCarriers(plan, *robot, choice);
    });
}

bool Dispatcher::HasPorts(const ActivePlan& plan, const Robot& robot) const
{
    return !_ports.JudgePorts(plan, robot).unavailabilityOrNull.has_value();
}

bool Dispatcher::CanExecute(ActivePlan& plan, const Robot& robot) const
{
    if (!_coordinator.CanServe(robot, plan))
    {
        return false;
    }
    std::optional<std::string> reason = DescribeRejectionOrNull(plan, robot);
    if (reason.has_value())
    {
        plan.verdicts.rejections.insert_or_assign(robot.index, JobRejection{robot.view.jobCheck, std::move(*reason)});
    }
    return !reason.has_value();
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
    return FindTravelSecondsOrNull(_router, plan, robot).has_value();
}

std::optional<double> Dispatcher::GetTravelSecondsOrNull(const ActivePlan& plan, const Robot& robot) const
{
    return FindTravelSecondsOrNull(_coordinator.GetOpenRouter(), plan, robot);
}

std::optional<double> Dispatcher::FindTravelSecondsOrNull(
    const Router& router,
    const ActivePlan& plan,
    const Robot& robot) const
{
    const std::string& vehicleTypeID = robot.options->vehicleTypeID;
    const std::optional<std::size_t> dock =
        _admission.FindDockOrNull(plan.resolved.steps.front().stationID, vehicleTypeID);
    if (!dock.has_value())
    {
        return std::nullopt;
    }
    const std::array start{*robot.place.node};
    const std::optional<QuickestStart> way =
        router.FindQuickestStartOrNull(vehicleTypeID, robot.GetLoad(), start, *dock);
    return way.has_value() ? std::optional(way->travelSeconds) : std::nullopt;
}

void Dispatcher::ForgetKeptRobots() noexcept
{
    _kept.clear();
}

void Dispatcher::KeepRobot(const Robot& robot, const ActivePlan& plan)
{
    _kept.insert_or_assign(robot.index, plan.key);
}

const ActivePlan* Dispatcher::FindKeeperOrNull(const ActivePlan& plan, const Robot& robot) const
{
    const auto kept = _kept.find(robot.index);
    if (kept == _kept.end() || kept->second.rank >= plan.key.rank)
    {
        return nullptr;
    }
    const auto keeper = _plans.GetQueue().find(kept->second);
    return keeper == _plans.GetQueue().end() ? nullptr : keeper->second;
}

void Dispatcher::OnJobCheck(Robot& robot, const JobCheckChanged& event)
{
    robot.view.jobCheck = event.jobCheck;
    _transaction.RequestDispatch();
}

bool Dispatcher::HasKnownRejection(const ActivePlan& plan, const Robot& robot)
{
    const auto known = plan.verdicts.rejections.find(robot.index);
    return known != plan.verdicts.rejections.end() && known->second.check == robot.view.jobCheck;
}

std::optional<std::string> Dispatcher::DescribeRejectionOrNull(const ActivePlan& plan, const Robot& robot)
{
    if (robot.view.jobCheck == nullptr)
    {
        return std::nullopt;
    }
    if (HasKnownRejection(plan, robot))
    {
        return plan.verdicts.rejections.at(robot.index).reason;
    }
    if (plan.verdicts.acceptance.check == robot.view.jobCheck && plan.verdicts.acceptance.robot == robot.index)
    {
        return std::nullopt;
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
                return reason;
            }
        }
    }
    plan.verdicts.acceptance = {robot.view.jobCheck, robot.index};
    return std::nullopt;
}

bool Dispatcher::IsRejectedByAll(const ActivePlan& plan) const
{
    const JobAcceptance& acceptance = plan.verdicts.acceptance;
    if (acceptance.check != nullptr && acceptance.check == _fleet[acceptance.robot].view.jobCheck)
    {
        return false;
    }
    return std::ranges::all_of(plan.resolved.candidates, [this, &plan](std::size_t index) {
        const Robot& robot = _fleet[index];
        return robot.view.bOnline && DescribeRejectionOrNull(plan, robot).has_value();
    });
}

std::string Dispatcher::DescribeRejections(const ActivePlan& plan) const
{
    std::string text;
    for (const std::size_t index : plan.resolved.candidates)
    {
        if (const std::optional<std::string> reason = DescribeRejectionOrNull(plan, _fleet[index]))
        {
            text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", _fleet[index].GetID(), *reason);
        }
    }
    return fmt::format("No robot can execute the plan: {}.", text);
}

const PortCheck& Dispatcher::GetPorts() const noexcept
{
    return _ports;
}

} // namespace ACS::Planning

#include "EngineLoop.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

Planning::SubmitPlan* GetPlanOrNull(EngineTask& task)
{
    auto* const commandOrNull = std::get_if<Planning::PlanCommand>(&task);
    return commandOrNull == nullptr ? nullptr : std::get_if<Planning::SubmitPlan>(commandOrNull);
}

const Planning::StateChanged* GetStateOrNull(const EngineTask& task)
{
    const auto* const robotOrNull = std::get_if<RobotTask>(&task);
    return robotOrNull == nullptr ? nullptr : std::get_if<Planning::StateChanged>(&robotOrNull->event);
}

} // namespace

EngineLoop::EngineLoop(
    Planning::PlanEngine& engine,
    const Core::IClock& clock,
    ExecuteHandler execute,
    StoreHandler store)
    : _engine(engine),
      _clock(clock),
      _execute(std::move(execute)),
      _store(std::move(store))
{
}

void EngineLoop::Restore(Planning::StoredState state)
{
    _engine.Restore(std::move(state), _clock.GetNow(), _actions);
    Work();
}

void EngineLoop::Push(EngineTask task)
{
    if (_bClosed)
    {
        Refuse(task);
        return;
    }
    if (!TryMerge(task))
    {
        _tasks.push_back(std::move(task));
    }
    Work();
}

/// Into the robot's latest task, where that is a state too and nothing but numbers that go by has changed since: nothing
/// that the engine decides on is lost, and nothing changes its place.
bool EngineLoop::TryMerge(const EngineTask& task)
{
    const Planning::StateChanged* const freshOrNull = GetStateOrNull(task);
    if (freshOrNull == nullptr)
    {
        return false;
    }
    const std::string& robotID = std::get<RobotTask>(task).robotID;
    const auto latest = std::find_if(_tasks.rbegin(), _tasks.rend(), [&robotID](const EngineTask& waiting) {
        const auto* const robotOrNull = std::get_if<RobotTask>(&waiting);
        return robotOrNull != nullptr && robotOrNull->robotID == robotID;
    });
    const Planning::StateChanged* const oldOrNull = latest == _tasks.rend() ? nullptr : GetStateOrNull(*latest);
    if (oldOrNull == nullptr)
    {
        return false;
    }
    Planning::StateChanged moved = *oldOrNull;
    moved.x = freshOrNull->x;
    moved.y = freshOrNull->y;
    moved.theta = freshOrNull->theta;
    moved.batteryPercent = freshOrNull->batteryPercent;
    if (moved != *freshOrNull)
    {
        return false;
    }
    std::get<RobotTask>(*latest).event = std::move(moved);
    return true;
}

void EngineLoop::OnStored(const Core::Result<void>& result)
{
    const Planning::StoreBatch batch = std::move(*std::exchange(_storing, std::nullopt));
    if (!result)
    {
        Planning::EngineActions instead;
        const std::span<const Planning::EngineAction> skipped = std::span(_actions).subspan(_executed);
        _engine.OnStoreFailed(batch, skipped, Core::Describe(result.error()), _clock.GetNow(), instead);
        _actions = std::move(instead);
        _executed = 0;
    }
    Work();
}

void EngineLoop::OnStoreLost(const Core::Error& error)
{
    if (_storing.has_value() || _bClosed)
    {
        return;
    }
    assert(_executed == _actions.size());
    _actions.clear();
    _executed = 0;
    _engine.OnStoreLost(Core::Describe(error), _clock.GetNow(), _actions);
    Work();
}

bool EngineLoop::TryPush(Planning::PlanCommand command)
{
    if (_bClosed)
    {
        return false;
    }
    Push(std::move(command));
    return true;
}

void EngineLoop::Close()
{
    _bClosed = true;
    for (const EngineTask& task : std::exchange(_tasks, {}))
    {
        Refuse(task);
    }
}

bool EngineLoop::IsStoring() const noexcept
{
    return _storing.has_value();
}

std::size_t EngineLoop::GetWaitingCount() const noexcept
{
    return _tasks.size();
}

/// R1: who asked is answered. Nothing was begun, so the MCS may ask again.
void EngineLoop::Refuse(const EngineTask& task) const
{
    const auto* const commandOrNull = std::get_if<Planning::PlanCommand>(&task);
    if (commandOrNull == nullptr)
    {
        return;
    }
    const auto refuse = [this](Planning::ReplyToken token) {
        _execute(Planning::ReplyCommand{token, false, "acsd draining for shutdown"});
    };
    std::visit(
        Core::Overloaded{
            [](const Planning::MessageAcknowledged&) { /* nobody waits */ },
            [&refuse](const auto& command) {
                refuse(command.replyToken);
            }},
        *commandOrNull);
}

void EngineLoop::Work()
{
    if (std::exchange(_bWorking, true))
    {
        return; // an action has brought a task: the call below sees it
    }
    while (!_storing.has_value() && (_executed < _actions.size() || !_tasks.empty()))
    {
        if (_executed < _actions.size())
        {
            ExecuteNext();
        }
        else
        {
            CallEngine();
        }
    }
    _bWorking = false;
}

void EngineLoop::ExecuteNext()
{
    const Planning::EngineAction action = std::move(_actions[_executed]);
    ++_executed;
    if (const auto* const storeOrNull = std::get_if<Planning::StorePlans>(&action))
    {
        _storing = storeOrNull->batch;
        _store(*_storing);
    }
    else
    {
        _execute(action);
    }
}

void EngineLoop::CallEngine()
{
    _actions.clear();
    _executed = 0;
    const Core::Now now = _clock.GetNow();
    std::vector<Planning::SubmitPlan> plans;
    while (!_tasks.empty() && GetPlanOrNull(_tasks.front()) != nullptr)
    {
        plans.push_back(std::move(*GetPlanOrNull(_tasks.front())));
        _tasks.pop_front();
    }
    if (!plans.empty())
    {
        _engine.Submit(plans, now, _actions);
        return;
    }
    const EngineTask task = std::move(_tasks.front());
    _tasks.pop_front();
    std::visit(
        Core::Overloaded{
            [&](const Planning::PlanCommand& command) { _engine.Handle(command, now, _actions); },
            [&](const RobotTask& robot) { _engine.Handle(robot.robotID, robot.event, now, _actions); },
            [&](const Planning::EngineTimer& timer) {
                _engine.OnTimer(timer, now, _actions);
            }},
        task);
}

} // namespace ACS::Acsd

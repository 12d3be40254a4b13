#include <acs/core/Overloaded.hpp>
#include <acs/plan/PlanEngineHost.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

SubmitPlan* GetPlanOrNull(EngineInput& input)
{
    auto* const commandOrNull = std::get_if<PlanCommand>(&input);
    return commandOrNull == nullptr ? nullptr : std::get_if<SubmitPlan>(commandOrNull);
}

const StateChanged* GetStateOrNull(const EngineInput& input)
{
    const auto* const robotOrNull = std::get_if<RobotInput>(&input);
    return robotOrNull == nullptr ? nullptr : std::get_if<StateChanged>(&robotOrNull->event);
}

} // namespace

PlanEngineHost::PlanEngineHost(
    PlanEngine& engine,
    const Core::IClock& clock,
    ExecuteHandler execute,
    StoreHandler store)
    : _engine(engine),
      _clock(clock),
      _execute(std::move(execute)),
      _store(std::move(store))
{
}

void PlanEngineHost::Restore(StoredState state)
{
    EngineActions actions;
    _engine.Restore(std::move(state), _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

void PlanEngineHost::Push(EngineInput input)
{
    if (_bClosed)
    {
        Reject(input);
        return;
    }
    if (!TryMerge(input))
    {
        _inputs.push_back(std::move(input));
    }
    Work();
}

/// Into the robot's latest input, if that is a state too and nothing but pose and battery has changed since: nothing that
/// the engine decides on is lost, and no input changes its place in the queue.
bool PlanEngineHost::TryMerge(const EngineInput& input)
{
    const StateChanged* const freshOrNull = GetStateOrNull(input);
    if (freshOrNull == nullptr)
    {
        return false;
    }
    const std::string& robotID = std::get<RobotInput>(input).robotID;
    const auto latest = std::find_if(_inputs.rbegin(), _inputs.rend(), [&robotID](const EngineInput& waiting) {
        const auto* const robotOrNull = std::get_if<RobotInput>(&waiting);
        return robotOrNull != nullptr && robotOrNull->robotID == robotID;
    });
    const StateChanged* const oldOrNull = latest == _inputs.rend() ? nullptr : GetStateOrNull(*latest);
    if (oldOrNull == nullptr)
    {
        return false;
    }
    StateChanged moved = *oldOrNull;
    moved.x = freshOrNull->x;
    moved.y = freshOrNull->y;
    moved.theta = freshOrNull->theta;
    moved.batteryPercent = freshOrNull->batteryPercent;
    if (moved != *freshOrNull)
    {
        return false;
    }
    std::get<RobotInput>(*latest).event = std::move(moved);
    return true;
}

void PlanEngineHost::OnStored(const Core::Result<void>& result)
{
    EngineActions actions;
    _engine.OnStored(result, _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

void PlanEngineHost::OnStoreLost(const Core::Error& error)
{
    if (IsStoring() || _bClosed)
    {
        return;
    }
    EngineActions actions;
    _engine.OnStoreLost(Core::Describe(error), _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

bool PlanEngineHost::TryPush(PlanCommand command)
{
    if (_bClosed)
    {
        return false;
    }
    Push(std::move(command));
    return true;
}

void PlanEngineHost::Close()
{
    _bClosed = true;
    for (const EngineInput& input : std::exchange(_inputs, {}))
    {
        Reject(input);
    }
}

bool PlanEngineHost::IsStoring() const noexcept
{
    return _engine.IsStoring();
}

std::size_t PlanEngineHost::GetWaitingCount() const noexcept
{
    return _inputs.size();
}

/// R1: every request is answered. Nothing was begun, so the MCS may repeat it.
void PlanEngineHost::Reject(const EngineInput& input) const
{
    const auto* const commandOrNull = std::get_if<PlanCommand>(&input);
    if (commandOrNull == nullptr)
    {
        return;
    }
    std::visit(
        Core::Overloaded{
            [](const MessageAcknowledged&) { /* has no reply */ },
            [this](const auto& command) {
                _execute(ReplyCommand{command.replyToken, false, "The ACS is shutting down."});
            }},
        *commandOrNull);
}

void PlanEngineHost::Work()
{
    if (std::exchange(_bWorking, true))
    {
        return; // an action or the store has called back: the loop below continues
    }
    while (!_actions.empty() || (!IsStoring() && !_inputs.empty()))
    {
        if (_actions.empty())
        {
            CallEngine();
        }
        else
        {
            ExecuteNext();
        }
    }
    _bWorking = false;
}

void PlanEngineHost::ExecuteNext()
{
    const EngineAction action = std::move(_actions.front());
    _actions.pop_front();
    if (const auto* const storeOrNull = std::get_if<StorePlans>(&action))
    {
        _store(storeOrNull->batch);
    }
    else
    {
        _execute(action);
    }
}

void PlanEngineHost::CallEngine()
{
    const Core::Now now = _clock.GetNow();
    EngineActions actions;
    std::vector<SubmitPlan> plans;
    while (!_inputs.empty() && GetPlanOrNull(_inputs.front()) != nullptr)
    {
        plans.push_back(std::move(*GetPlanOrNull(_inputs.front())));
        _inputs.pop_front();
    }
    if (plans.empty())
    {
        const EngineInput input = std::move(_inputs.front());
        _inputs.pop_front();
        std::visit(
            Core::Overloaded{
                [&](const PlanCommand& command) { _engine.Handle(command, now, actions); },
                [&](const RobotInput& robot) { _engine.Handle(robot.robotID, robot.event, now, actions); },
                [&](const EngineTimer& timer) {
                    _engine.OnTimer(timer, now, actions);
                }},
            input);
    }
    else
    {
        _engine.Submit(plans, now, actions);
    }
    Append(std::move(actions));
}

void PlanEngineHost::Append(EngineActions actions)
{
    std::ranges::move(actions, std::back_inserter(_actions));
}

} // namespace ACS::Planning

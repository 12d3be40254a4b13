#include "engine/InputQueue.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// A class is postponed at most this often before it has its turn.
constexpr std::size_t LONGEST_POSTPONEMENT = 16;

template <typename TInput>
RobotEvent& GetEvent(TInput& input)
{
    return std::get<RobotInput>(input).event;
}

std::size_t CountBytes(const std::optional<std::string>& text)
{
    return text.has_value() ? text->size() : 0;
}

/// Memory of the plan, about.
std::size_t CountBytes(const Plan& plan)
{
    std::size_t bytes = sizeof(Plan) + plan.planID.size() + plan.lotID.size();
    for (const Step& step : plan.steps)
    {
        bytes += sizeof(Step) + step.action.size() + step.position.size();
        for (const std::string& carrierID : step.carrierIDs)
        {
            bytes += sizeof(std::string) + carrierID.size();
        }
        for (const Job& job : step.jobs)
        {
            bytes += sizeof(Job) + job.jobID.size() + CountBytes(job.from) + CountBytes(job.to);
        }
    }
    return bytes;
}

/// Whether nothing but pose and battery differs.
bool IsMove(const StateChanged& before, const StateChanged& after)
{
    StateChanged moved = before;
    moved.x = after.x;
    moved.y = after.y;
    moved.theta = after.theta;
    moved.batteryPercent = after.batteryPercent;
    return moved == after;
}

} // namespace

InputQueue::InputQueue(const InputLimits& limits)
    : _limits(limits)
{
}

bool InputQueue::TryPush(EngineInput& input, std::optional<CommandReceipt> receiptOrNull)
{
    return std::visit(
        Core::Overloaded{
            [this, &receiptOrNull](PlanCommand& command) { return TryPushCommand(command, std::move(receiptOrNull)); },
            [this](RobotInput& robot) {
                PushRobot(std::move(robot));
                return true;
            },
            [this](const EngineTimer& timer) {
                if (_timers.insert(timer).second)
                {
                    _urgent.emplace_back(timer);
                }
                return true;
            },
            [this](StoreLog& log) {
                if (!_storeLog.has_value())
                {
                    _urgent.emplace_back(StoreLog());
                }
                _storeLog = std::move(log);
                return true;
            }},
        input);
}

bool InputQueue::TryPushCommand(PlanCommand& command, std::optional<CommandReceipt> receiptOrNull)
{
    return std::visit(
        Core::Overloaded{
            [this](const MessageAcknowledged& acknowledged) {
                _acknowledged.insert(acknowledged.sequence);
                return true;
            },
            [this, &command](const SubmitPlan&) { return TryPushPlan(command); },
            [this, &command, &receiptOrNull](const ControlPlan&) {
                return TryPushControl(command, std::move(receiptOrNull));
            },
            [this, &command, &receiptOrNull](const auto&) {
                if (_operator.size() >= _limits.operatorCommands)
                {
                    return false;
                }
                _bStopWaits = _bStopWaits || IsStop(command);
                _operator.push_back({std::move(command), std::move(receiptOrNull)});
                return true;
            }},
        command);
}

bool InputQueue::TryPushPlan(PlanCommand& command)
{
    if (_planCount >= _limits.plans || _planBytes >= _limits.planBytes)
    {
        return false;
    }
    ++_planCount;
    _planBytes += CountBytes(std::get<SubmitPlan>(command).plan);
    _plans.push_back({std::move(command), std::nullopt});
    return true;
}

bool InputQueue::TryPushControl(PlanCommand& command, std::optional<CommandReceipt> receiptOrNull)
{
    if (_controlCount >= _limits.controls)
    {
        return false;
    }
    ++_controlCount;
    const bool bPlanWaits =
        std::ranges::any_of(_plans, [&planID = std::get<ControlPlan>(command).planID](const OfferedCommand& waiting) {
            const auto* const planOrNull = std::get_if<SubmitPlan>(&waiting.command);
            const auto* const controlOrNull = std::get_if<ControlPlan>(&waiting.command);
            return (planOrNull != nullptr && planOrNull->plan.planID == planID)
                || (controlOrNull != nullptr && controlOrNull->planID == planID);
        });
    OfferedCommand queued{std::move(command), std::move(receiptOrNull)};
    if (bPlanWaits)
    {
        _plans.push_back(std::move(queued));
    }
    else
    {
        _urgent.emplace_back(std::move(queued));
    }
    return true;
}

void InputQueue::PushRobot(RobotInput input)
{
    RobotInputs& waiting = _robots[input.robotID];
    const bool bFull = waiting.size() >= _limits.robotEvents;
    if (!TryMerge(waiting, input.event) && !(bFull && TryReplace(waiting, input.event)))
    {
        waiting.push_back(_urgent.insert(_urgent.end(), std::move(input)));
    }
}

bool InputQueue::TryMerge(const RobotInputs& waiting, const RobotEvent& event)
{
    if (std::holds_alternative<JobCheckChanged>(event) || std::holds_alternative<CompatibilityChanged>(event))
    {
        // What the robot can execute: the latest counts, in any order with other events.
        const auto same = std::ranges::find_if(waiting, [&event](const Inputs::iterator input) {
            return GetEvent(*input).index() == event.index();
        });
        if (same != waiting.end())
        {
            GetEvent(**same) = event;
        }
        return same != waiting.end();
    }
    const auto* const stateOrNull = std::get_if<StateChanged>(&event);
    if (stateOrNull == nullptr || waiting.empty())
    {
        return false;
    }
    RobotEvent& latest = GetEvent(*waiting.back());
    const auto* const beforeOrNull = std::get_if<StateChanged>(&latest);
    if (beforeOrNull == nullptr || !IsMove(*beforeOrNull, *stateOrNull))
    {
        return false;
    }
    latest = *stateOrNull;
    return true;
}

/// Events of drives and jobs stay: an adapter raises a limited number of them for each command, and no command is sent while
/// they wait.
bool InputQueue::TryReplace(RobotInputs& waiting, const RobotEvent& event)
{
    const auto isLatest = [&waiting](auto isMeant) {
        return !waiting.empty() && isMeant(GetEvent(*waiting.back()));
    };
    const auto isState = [](const RobotEvent& latest) {
        return std::holds_alternative<StateChanged>(latest);
    };
    if (isState(event) && isLatest(isState))
    {
        GetEvent(*waiting.back()) = event;
        return true;
    }
    const auto* const linkOrNull = std::get_if<LinkChanged>(&event);
    if (linkOrNull == nullptr)
    {
        return false;
    }
    const auto last = std::find_if(waiting.rbegin(), waiting.rend(), [](const Inputs::iterator input) {
        return std::holds_alternative<LinkChanged>(GetEvent(*input));
    });
    if (last != waiting.rend() && GetEvent(**last) == event)
    {
        return true;
    }
    const auto dropLatest = [this, &waiting] {
        _urgent.erase(waiting.back());
        waiting.pop_back();
    };
    while (!linkOrNull->bOnline && isLatest(isState))
    {
        dropLatest(); // outdated by the disconnection
    }
    const auto isConnection = [](const RobotEvent& latest) {
        return latest == RobotEvent(LinkChanged{true});
    };
    if (!linkOrNull->bOnline && isLatest(isConnection))
    {
        dropLatest();
        return true;
    }
    return false;
}

InputQueue::Next InputQueue::Pop()
{
    assert(!IsEmpty());
    if (!_acknowledged.empty())
    {
        return Commands{{MessageAcknowledged{_acknowledged.extract(_acknowledged.begin()).value()}}};
    }
    switch (ChooseClass())
    {
        case EClass::Plans:
            return PopPlans();
        case EClass::Operator:
            _bStopWaits = false;
            return std::exchange(_operator, {});
        case EClass::Urgent:
        default:
            return PopUrgent();
    }
}

bool InputQueue::IsStop(const PlanCommand& command)
{
    const auto* const tscOrNull = std::get_if<ControlTSC>(&command);
    const auto* const maintenanceOrNull = std::get_if<SetMaintenance>(&command);
    return std::holds_alternative<BlockPlace>(command) || (tscOrNull != nullptr && tscOrNull->bPause)
        || (maintenanceOrNull != nullptr && maintenanceOrNull->bOn);
}

InputQueue::EClass InputQueue::ChooseClass()
{
    const bool bStopBefore = std::exchange(_bStopBefore, false);
    if (_bStopWaits && !bStopBefore)
    {
        _bStopBefore = true;
        _postponed.at(static_cast<std::size_t>(EClass::Operator)) = 0;
        return EClass::Operator;
    }
    const std::array<bool, CLASSES> bWaiting{!_urgent.empty(), !_plans.empty(), !_operator.empty()};
    const auto isDue = [](std::size_t count) {
        return count >= LONGEST_POSTPONEMENT;
    };
    const bool bDue = std::ranges::any_of(_postponed, isDue);
    const std::ptrdiff_t position = bDue ? std::ranges::find_if(_postponed, isDue) - _postponed.begin()
                                         : std::ranges::find(bWaiting, true) - bWaiting.begin();
    const auto chosen = static_cast<std::size_t>(position);
    _postponed.at(chosen) = 0;
    for (std::size_t index = chosen + 1; index < CLASSES; ++index)
    {
        _postponed.at(index) += bWaiting.at(index) ? 1U : 0U;
    }
    return static_cast<EClass>(chosen);
}

InputQueue::Next InputQueue::PopUrgent()
{
    auto input = std::move(_urgent.front());
    _urgent.pop_front();
    return std::visit(
        Core::Overloaded{
            [this](OfferedCommand& queued) -> Next {
                --_controlCount;
                return Commands{std::move(queued)};
            },
            [this](RobotInput& robot) -> Next {
                _robots.find(robot.robotID)->second.pop_front();
                return std::move(robot);
            },
            [this](EngineTimer& timer) -> Next {
                _timers.erase(timer);
                return std::move(timer);
            },
            [this](const StoreLog&) -> Next {
                return *std::exchange(_storeLog, std::nullopt);
            }},
        input);
}

/// The plans up to the next control, or that control.
InputQueue::Commands InputQueue::PopPlans()
{
    const auto isPlan = [](const OfferedCommand& queued) {
        return std::holds_alternative<SubmitPlan>(queued.command);
    };
    Commands commands;
    if (!isPlan(_plans.front()))
    {
        --_controlCount;
        commands.push_back(std::move(_plans.front()));
        _plans.pop_front();
        return commands;
    }
    while (!_plans.empty() && isPlan(_plans.front()))
    {
        --_planCount;
        _planBytes -= CountBytes(std::get<SubmitPlan>(_plans.front().command).plan);
        commands.push_back(std::move(_plans.front()));
        _plans.pop_front();
    }
    return commands;
}

void InputQueue::Remove(const EngineTimer& timer)
{
    if (_timers.erase(timer) == 0)
    {
        return;
    }
    _urgent.remove_if([&timer](const auto& input) {
        const auto* const timerOrNull = std::get_if<EngineTimer>(&input);
        return timerOrNull != nullptr && *timerOrNull == timer;
    });
}

std::vector<PlanCommand> InputQueue::Clear()
{
    std::vector<PlanCommand> commands;
    const auto append = [&commands](OfferedCommand& queued) {
        commands.push_back(std::move(queued.command));
    };
    for (auto& input : _urgent)
    {
        if (auto* const controlOrNull = std::get_if<OfferedCommand>(&input); controlOrNull != nullptr)
        {
            append(*controlOrNull);
        }
    }
    std::ranges::for_each(_plans, append);
    std::ranges::for_each(_operator, append);
    *this = InputQueue(_limits);
    return commands;
}

bool InputQueue::IsEmpty() const noexcept
{
    return GetCount() == 0;
}

std::size_t InputQueue::GetCount() const noexcept
{
    return _acknowledged.size() + _urgent.size() + _plans.size() + _operator.size();
}

} // namespace ACS::Planning

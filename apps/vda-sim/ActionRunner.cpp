#include "vda-sim/ActionRunner.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace ACS::VdaSim
{
ActionRunner::ActionRunner(std::map<std::string, double, std::less<>> seconds, LoadDevice device)
    : _seconds(std::move(seconds)),
      _device(std::move(device))
{
}

double ActionRunner::GetSeconds(std::string_view actionType) const
{
    const bool bPick = _device.IsPick(actionType);
    const bool bHandling = bPick || _device.IsDrop(actionType);
    const std::string_view meaning = !bHandling ? actionType
        : bPick                                 ? VDA5050::ActionTypes::PICK
                                                : VDA5050::ActionTypes::DROP;
    const auto known = _seconds.find(meaning);
    if (known != _seconds.end())
    {
        return known->second;
    }
    if (actionType == VDA5050::ActionTypes::WAIT_FOR_TRIGGER)
    {
        return std::numeric_limits<double>::infinity();
    }
    return bHandling ? HANDLING_SECONDS : SHORT_SECONDS;
}

std::string ActionRunner::FindRefusal(const VDA5050::Action& action, bool bAtCharger) const
{
    if (_device.IsDrop(action.actionType) && _device.GetLoads().empty())
    {
        return "no load on board";
    }
    if (action.actionType == VDA5050::ActionTypes::START_CHARGING && !bAtCharger)
    {
        return "no charger at this node";
    }
    return {};
}

void ActionRunner::Start(const VDA5050::Action& action, std::optional<VDA5050::VehicleError> failureOrNull)
{
    _running.push_back({action, GetSeconds(action.actionType), std::move(failureOrNull)});
}

std::size_t ActionRunner::Trigger()
{
    std::size_t count = 0;
    for (RunningAction& running : _running)
    {
        if (running.action.actionType == VDA5050::ActionTypes::WAIT_FOR_TRIGGER)
        {
            running.secondsLeft = 0.0;
            ++count;
        }
    }
    return count;
}

std::vector<ActionRunner::RunningAction>::iterator ActionRunner::Find(std::string_view actionID)
{
    return std::ranges::find_if(_running, [actionID](const RunningAction& running) {
        return running.action.actionID == actionID;
    });
}

bool ActionRunner::TryPause(std::string_view actionID)
{
    const auto found = Find(actionID);
    if (found == _running.end())
    {
        return false;
    }
    found->bPaused = true;
    return true;
}

bool ActionRunner::TryResume(std::string_view actionID)
{
    const auto found = Find(actionID);
    if (found == _running.end())
    {
        return false;
    }
    found->bPaused = false;
    return true;
}

std::optional<ActionOutcome> ActionRunner::StopOrNull(std::string_view actionID, bool bEdgeEnded)
{
    const auto found = Find(actionID);
    if (found == _running.end())
    {
        return std::nullopt;
    }
    const RunningAction stopped = std::move(*found);
    _running.erase(found);
    if (bEdgeEnded && stopped.action.actionType == VDA5050::ActionTypes::DETECT_OBJECT)
    {
        return Finish(stopped);
    }
    const std::string reason = bEdgeEnded ? "the edge ended before the action" : "stopped";
    return ActionOutcome{stopped.action.actionID, VDA5050::EActionStatus::Failed, reason, {}};
}

void ActionRunner::Advance(double seconds, std::vector<ActionOutcome>& out)
{
    for (RunningAction& running : _running)
    {
        running.secondsLeft -= running.bPaused ? 0.0 : seconds;
    }
    const auto isDone = [](const RunningAction& running) {
        return !running.bPaused && running.secondsLeft <= 0.0;
    };
    for (const RunningAction& running : _running)
    {
        if (isDone(running))
        {
            out.push_back(Finish(running));
        }
    }
    std::erase_if(_running, isDone);
}

ActionOutcome ActionRunner::Finish(const RunningAction& running)
{
    const VDA5050::Action& action = running.action;
    if (running.failure.has_value())
    {
        return {action.actionID, VDA5050::EActionStatus::Failed, running.failure->errorDescription, running.failure};
    }
    const bool bPick = _device.IsPick(action.actionType);
    if (bPick || _device.IsDrop(action.actionType))
    {
        std::string failure = bPick ? _device.PickUp(action) : _device.PutDown(action);
        const auto status = failure.empty() ? VDA5050::EActionStatus::Finished : VDA5050::EActionStatus::Failed;
        return {action.actionID, status, std::move(failure), {}};
    }
    if (action.actionType == VDA5050::ActionTypes::START_CHARGING)
    {
        if (running.bUndocked)
        {
            return {action.actionID, VDA5050::EActionStatus::Failed, "the vehicle left the charger", {}};
        }
        _bCharging = true;
    }
    else if (action.actionType == VDA5050::ActionTypes::STOP_CHARGING)
    {
        _bCharging = false;
    }
    ActionOutcome outcome{action.actionID, VDA5050::EActionStatus::Finished, {}, {}};
    if (action.actionType == VDA5050::ActionTypes::LOG_REPORT)
    {
        outcome.result = "log-" + action.actionID + ".txt";
    }
    return outcome;
}

void ActionRunner::Undock()
{
    _bCharging = false;
    for (RunningAction& running : _running)
    {
        running.bUndocked = true;
    }
}

bool ActionRunner::IsBusy() const noexcept
{
    return !_running.empty();
}

bool ActionRunner::IsCharging() const noexcept
{
    return _bCharging;
}

LoadDevice& ActionRunner::GetDevice() noexcept
{
    return _device;
}

} // namespace ACS::VdaSim

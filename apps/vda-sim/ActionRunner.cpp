#include "vda-sim/ActionRunner.hpp"

#include "vda-sim/VehicleFactsheet.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

std::string GetParameterText(const VDA5050::Action& action, std::string_view key)
{
    const VDA5050::ActionParameter* const parameter = VDA5050::FindParameterOrNull(action, key);
    if (parameter == nullptr)
    {
        return {};
    }
    return parameter->value.GetStringOrNull().value_or(parameter->value.GetText());
}

VDA5050::Load MakeLoad(const VDA5050::Action& action)
{
    VDA5050::Load load;
    load.loadID = GetParameterText(action, "loadId");
    load.loadType = GetParameterText(action, "loadType");
    load.loadPosition = GetParameterText(action, "lhd");
    return load;
}

} // namespace

ActionRunner::ActionRunner(std::map<std::string, double, std::less<>> seconds, std::vector<std::string> loadPositions)
    : _seconds(std::move(seconds)),
      _loadPositions(std::move(loadPositions))
{
}

double ActionRunner::GetSeconds(std::string_view actionType) const
{
    const auto known = _seconds.find(actionType);
    if (known != _seconds.end())
    {
        return known->second;
    }
    if (actionType == ACTION_WAIT_FOR_TRIGGER)
    {
        return std::numeric_limits<double>::infinity();
    }
    return actionType == ACTION_PICK || actionType == ACTION_DROP ? HANDLING_SECONDS : SHORT_SECONDS;
}

std::string ActionRunner::Start(
    const VDA5050::Action& action,
    bool bAtCharger,
    std::optional<VDA5050::VehicleError> failureOrNull)
{
    if (action.actionType == ACTION_DROP && _loads.empty())
    {
        return "there is no load on board";
    }
    if (action.actionType == ACTION_START_CHARGING && !bAtCharger)
    {
        return "there is no charger here";
    }
    _running.push_back({action, GetSeconds(action.actionType), std::move(failureOrNull), false});
    return {};
}

std::size_t ActionRunner::Trigger()
{
    std::size_t count = 0;
    for (RunningAction& running : _running)
    {
        if (running.action.actionType == ACTION_WAIT_FOR_TRIGGER)
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
    if (bEdgeEnded && stopped.action.actionType == ACTION_DETECT_OBJECT)
    {
        return Finish(stopped);
    }
    const std::string reason = bEdgeEnded ? "its edge has ended before it" : "stopped";
    return ActionOutcome{stopped.action.actionID, VDA5050::EActionStatus::Failed, reason, {}};
}

void ActionRunner::Advance(double seconds, std::vector<ActionOutcome>& out)
{
    for (RunningAction& running : _running)
    {
        running.secondsLeft -= running.bPaused ? 0.0 : seconds;
    }
    const auto isDone = [](const RunningAction& running) {
        return running.secondsLeft <= 0.0;
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
    if (action.actionType == ACTION_PICK)
    {
        return PickUp(action);
    }
    if (action.actionType == ACTION_DROP)
    {
        return PutDown(action);
    }
    if (action.actionType == ACTION_START_CHARGING)
    {
        _bCharging = true;
    }
    else if (action.actionType == ACTION_STOP_CHARGING)
    {
        _bCharging = false;
    }
    ActionOutcome outcome{action.actionID, VDA5050::EActionStatus::Finished, {}, {}};
    if (action.actionType == ACTION_LOG_REPORT)
    {
        outcome.result = "log-" + action.actionID + ".txt";
    }
    return outcome;
}

ActionOutcome ActionRunner::PickUp(const VDA5050::Action& action)
{
    const auto fail = [&action](std::string reason) {
        return ActionOutcome{action.actionID, VDA5050::EActionStatus::Failed, std::move(reason), {}};
    };
    const auto isFree = [this](std::string_view position) {
        return std::ranges::find(_loads, position, &VDA5050::Load::loadPosition) == _loads.end();
    };
    VDA5050::Load load = MakeLoad(action);
    if (std::max(load.loadID->size(), load.loadType.size()) > MAX_ID_LENGTH)
    {
        return fail("the load's id or type is too long");
    }
    if (!load.loadID->empty() && std::ranges::find(_loads, load.loadID, &VDA5050::Load::loadID) != _loads.end())
    {
        return fail("this load is on board already");
    }
    // The place that is named, else the first free one.
    const auto place = std::ranges::find_if(_loadPositions, [&](const std::string& position) {
        return load.loadPosition.empty() ? isFree(position) : position == load.loadPosition;
    });
    if (place == _loadPositions.end())
    {
        return fail(
            load.loadPosition.empty() ? "there is no free place for a load" : "there is no such place for a load");
    }
    if (!isFree(*place))
    {
        return fail("there is a load in this place already");
    }
    load.loadPosition = *place;
    _loads.push_back(std::move(load));
    return {action.actionID, VDA5050::EActionStatus::Finished, {}, {}};
}

ActionOutcome ActionRunner::PutDown(const VDA5050::Action& action)
{
    // The load that is named, else the one in the place that is named, else the last one.
    const VDA5050::Load wanted = MakeLoad(action);
    auto found = std::ranges::find_if(_loads, [&wanted](const VDA5050::Load& load) {
        return !wanted.loadID->empty() ? load.loadID == wanted.loadID : load.loadPosition == wanted.loadPosition;
    });
    if (found == _loads.end() && wanted.loadID->empty() && wanted.loadPosition.empty() && !_loads.empty())
    {
        found = std::prev(_loads.end());
    }
    if (found == _loads.end())
    {
        return {action.actionID, VDA5050::EActionStatus::Failed, "this load is not on board", {}};
    }
    _loads.erase(found);
    return {action.actionID, VDA5050::EActionStatus::Finished, {}, {}};
}

void ActionRunner::Undock()
{
    _bCharging = false;
}

bool ActionRunner::IsBusy() const noexcept
{
    return !_running.empty();
}

bool ActionRunner::IsCharging() const noexcept
{
    return _bCharging;
}

const std::vector<VDA5050::Load>& ActionRunner::GetLoads() const noexcept
{
    return _loads;
}

} // namespace ACS::VdaSim

#include "vda-sim/ActionRunner.hpp"

#include "vda-sim/VehicleFactsheet.hpp"

#include <algorithm>
#include <optional>

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

std::string ActionRunner::Start(const VDA5050::Action& action, bool bAtCharger)
{
    const bool bHandling = action.actionType == ACTION_PICK || action.actionType == ACTION_DROP;
    if (action.actionType == ACTION_DROP && _loads.empty())
    {
        return "there is no load on board";
    }
    if (action.actionType == ACTION_START_CHARGING && !bAtCharger)
    {
        return "there is no charger here";
    }
    _running.push_back({action, bHandling ? HANDLING_SECONDS : SHORT_SECONDS, false});
    return {};
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

bool ActionRunner::TryStop(std::string_view actionID)
{
    const auto found = Find(actionID);
    if (found == _running.end())
    {
        return false;
    }
    _running.erase(found);
    return true;
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
            out.push_back(Finish(running.action));
        }
    }
    std::erase_if(_running, isDone);
}

ActionOutcome ActionRunner::Finish(const VDA5050::Action& action)
{
    if (action.actionType == ACTION_PICK)
    {
        _loads.push_back(MakeLoad(action));
    }
    else if (action.actionType == ACTION_DROP)
    {
        return PutDown(action);
    }
    else if (action.actionType == ACTION_START_CHARGING)
    {
        _bCharging = true;
    }
    else if (action.actionType == ACTION_STOP_CHARGING)
    {
        _bCharging = false;
    }
    return {action.actionID, VDA5050::EActionStatus::Finished, {}};
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
        return {action.actionID, VDA5050::EActionStatus::Failed, "this load is not on board"};
    }
    _loads.erase(found);
    return {action.actionID, VDA5050::EActionStatus::Finished, {}};
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

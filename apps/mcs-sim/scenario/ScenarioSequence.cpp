#include "scenario/ScenarioSequence.hpp"

#include <algorithm>
#include <utility>

namespace ACS::McsSim
{

ScenarioSequence::ScenarioSequence(std::vector<Scenario> scenarios, Core::IRandom& random, PlanRefresher refresher)
    : _refresher(std::move(refresher))
{
    for (Scenario& scenario : scenarios)
    {
        _runners.push_back(std::make_unique<ScenarioRunner>(std::move(scenario), _refresher, random));
    }
}

void ScenarioSequence::Start(Core::Now now, ScenarioActions& out)
{
    if (!_bStarted)
    {
        _bStarted = true;
        Run([this, now, &out](ScenarioRunner& runner) { runner.Start(_bRegistered, now, out); }, now, out);
    }
}

void ScenarioSequence::OnRegistered(Core::Now now, ScenarioActions& out)
{
    _bRegistered = true;
    Run([now, &out](ScenarioRunner& runner) { runner.OnRegistered(now, out); }, now, out);
}

void ScenarioSequence::OnLinkLost()
{
    _bRegistered = false;
    if (!IsFinished())
    {
        _runners[_index]->OnLinkLost();
    }
}

void ScenarioSequence::OnMessage(std::string_view text, Core::Now now, ScenarioActions& out)
{
    Run([text, now, &out](ScenarioRunner& runner) { runner.OnMessage(text, now, out); }, now, out);
}

void ScenarioSequence::OnTimer(Core::Now now, ScenarioActions& out)
{
    Run([now, &out](ScenarioRunner& runner) { runner.OnTimer(now, out); }, now, out);
}

void ScenarioSequence::OnSendFailed(Core::Now now, ScenarioActions& out)
{
    Run([now, &out](ScenarioRunner& runner) { runner.OnSendFailed(now, out); }, now, out);
}

bool ScenarioSequence::IsFinished() const noexcept
{
    return _index >= _runners.size();
}

bool ScenarioSequence::IsEmpty() const noexcept
{
    return _runners.empty();
}

std::vector<ScenarioResult> ScenarioSequence::GetResults() const
{
    std::vector<ScenarioResult> results;
    for (const std::unique_ptr<ScenarioRunner>& runner : _runners)
    {
        results.push_back({runner->GetName(), runner->GetVerdicts(), runner->HasHeld()});
    }
    return results;
}

bool ScenarioSequence::HasHeld() const
{
    return std::all_of(_runners.begin(), _runners.end(), [](const auto& runner) { return runner->HasHeld(); });
}

void ScenarioSequence::Run(const std::function<void(ScenarioRunner&)>& call, Core::Now now, ScenarioActions& out)
{
    if (!_bStarted || IsFinished())
    {
        return;
    }
    call(*_runners[_index]);
    while (!IsFinished() && _runners[_index]->IsFinished())
    {
        // The faults of one scenario are not those of the next.
        out.emplace_back(EndFaults{});
        _bRegistered = _bRegistered && _runners[_index]->IsRegistered();
        ++_index;
        if (!IsFinished())
        {
            _runners[_index]->Start(_bRegistered, now, out);
        }
    }
}

} // namespace ACS::McsSim

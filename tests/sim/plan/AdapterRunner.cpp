#include "AdapterRunner.hpp"

#include <acs/core/Overloaded.hpp>

#include <variant>

namespace ACS::Simulation
{

AdapterRunner::AdapterRunner(
    Timeline& timeline,
    Planning::IRobotAdapter& adapter,
    ISimulatedRobot::EventHandler handler,
    std::function<void()> afterwards)
    : _timeline(timeline),
      _adapter(adapter),
      _handler(std::move(handler)),
      _afterwards(std::move(afterwards)),
      _timers(timeline)
{
}

void AdapterRunner::ExecuteAll()
{
    while (!_actions.empty())
    {
        const Planning::AdapterAction action = std::move(_actions.front());
        _actions.pop_front();
        Execute(action);
    }
    _bExecuting = false;
    if (_afterwards)
    {
        _afterwards();
    }
}

void AdapterRunner::Execute(const Planning::AdapterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::RaiseEvent& raise) { _handler(raise.event); },
            [this](const Planning::StartAdapterTimer& start) {
                const Planning::AdapterTimerID timer = start.timer;
                _timers.Start(timer, start.delay, [this, timer] {
                    Run([this, timer](Core::Now now, auto& out) { _adapter.OnTimer(timer, now, out); });
                });
            },
            [this](const Planning::CancelAdapterTimer& cancel) {
                _timers.Cancel(cancel.timer);
            }},
        action);
}

} // namespace ACS::Simulation

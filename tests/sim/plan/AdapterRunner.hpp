#pragma once

#include "ISimulatedRobot.hpp"
#include "TimerBank.hpp"
#include <acs/plan/IRobotAdapter.hpp>

#include <algorithm>
#include <deque>
#include <functional>
#include <iterator>
#include <utility>

namespace ACS::Simulation
{

/// Runs the adapter of one robot as RobotRunner does: gives it time, keeps its timers, passes its events on, and carries
/// out its actions in order, also those that are added in the meantime.
class AdapterRunner final
{
    Timeline& _timeline;
    Planning::IRobotAdapter& _adapter;
    ISimulatedRobot::EventHandler _handler;
    std::function<void()> _afterwards;
    TimerBank<Planning::AdapterTimerID> _timers;
    std::deque<Planning::AdapterAction> _actions;
    bool _bExecuting = false;

public:
    /// The adapter outlives the runner. Afterwards (it may be empty) is called when everything has been carried out.
    AdapterRunner(
        Timeline& timeline,
        Planning::IRobotAdapter& adapter,
        ISimulatedRobot::EventHandler handler,
        std::function<void()> afterwards);

    /// Calls a function of the adapter with the time, and carries out the requested actions.
    template <typename TCall>
    void Run(TCall call)
    {
        Planning::AdapterActions wanted;
        call(_timeline.GetNow(), wanted);
        std::ranges::move(wanted, std::back_inserter(_actions));
        if (!std::exchange(_bExecuting, true))
        {
            ExecuteAll();
        }
    }

private:
    void Execute(const Planning::AdapterAction& action);
    void ExecuteAll();
};

} // namespace ACS::Simulation

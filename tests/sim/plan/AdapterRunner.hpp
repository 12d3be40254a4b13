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

/// Runs the adapter of one robot as RobotHost does: gives it time, keeps its timers, passes its events on, and carries out
/// what it wants one after the other, also where that leads back to it.
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

    /// The call is one of the adapter's functions, which is given the time and takes what it wants.
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

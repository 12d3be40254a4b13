#pragma once

#include "IRobotHand.hpp"
#include "ISimulatedRobot.hpp"
#include "MemoryRobotAdapter.hpp"
#include "RobotRadio.hpp"
#include "TimerBank.hpp"

#include <deque>
#include <functional>
#include <string>

namespace ACS::Simulation
{

/// Runs the adapter of one robot in memory as RobotHost runs those of real ones: gives it events and time, keeps its
/// timers, passes its events on.
class RobotHand final : public IRobotHand, private IRadioListener
{
public:
    using EventHandler = ISimulatedRobot::EventHandler;

private:
    Timeline& _timeline;
    RobotRadio& _radio;
    EventHandler _handler;
    TimerBank<Planning::AdapterTimerID> _timers;
    MemoryRobotAdapter _adapter;
    std::deque<Planning::AdapterAction> _actions;
    bool _bExecuting = false;

    template <typename TCall>
    void Call(TCall call);
    void Execute(const Planning::AdapterAction& action);
    void OnRadioUp() override;
    void OnRadioDown() override;
    void OnSnapshot(const RobotSnapshot& snapshot) override;

public:
    RobotHand(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler);
    RobotHand(const RobotHand&) = delete;
    RobotHand& operator=(const RobotHand&) = delete;
    ~RobotHand() override;

    void Handle(const Planning::RobotCommand& command) override;
};

} // namespace ACS::Simulation

#pragma once

#include "AdapterRunner.hpp"
#include "IRobotHand.hpp"
#include "ISimulatedRobot.hpp"
#include "MemoryRobotAdapter.hpp"
#include "RobotRadio.hpp"

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
    RobotRadio& _radio;
    MemoryRobotAdapter _adapter;
    AdapterRunner _runner;

public:
    RobotHand(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler);
    RobotHand(const RobotHand&) = delete;
    RobotHand& operator=(const RobotHand&) = delete;
    ~RobotHand() override;

    void Handle(const Planning::RobotCommand& command) override;

private:
    void OnRadioUp() override;
    void OnRadioDown() override;
    void OnSnapshot(const RobotSnapshot& snapshot) override;
};

} // namespace ACS::Simulation

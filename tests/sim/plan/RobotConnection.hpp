#pragma once

#include "AdapterRunner.hpp"
#include "IRobotConnection.hpp"
#include "ISimulatedRobot.hpp"
#include "MemoryRobotAdapter.hpp"
#include "RobotRadio.hpp"

#include <functional>
#include <string>

namespace ACS::Simulation
{

/// Runs the adapter of one robot in memory as RobotRunner runs those of real ones: gives it events and time, keeps its
/// timers, passes its events on.
class RobotConnection final : public IRobotConnection, private IRadioListener
{
public:
    using EventHandler = ISimulatedRobot::EventHandler;

private:
    RobotRadio& _radio;
    MemoryRobotAdapter _adapter;
    AdapterRunner _runner;

public:
    RobotConnection(Timeline& timeline, RobotRadio& radio, std::uint64_t number, EventHandler handler);
    RobotConnection(const RobotConnection&) = delete;
    RobotConnection& operator=(const RobotConnection&) = delete;
    ~RobotConnection() override;

    void Handle(const Planning::RobotCommand& command) override;

private:
    void OnRadioUp() override;
    void OnRadioDown() override;
    void OnSnapshot(const RobotSnapshot& snapshot) override;
};

} // namespace ACS::Simulation

#pragma once

#include "IRobotConnection.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace ACS::Simulation
{

/// A robot with its own state, which continues while acsd is down, and its connection to acsd.
class ISimulatedRobot
{
public:
    using EventHandler = std::function<void(const Planning::RobotEvent& event)>;

    ISimulatedRobot() = default;
    ISimulatedRobot(const ISimulatedRobot&) = delete;
    ISimulatedRobot& operator=(const ISimulatedRobot&) = delete;
    virtual ~ISimulatedRobot() = default;

    /// The adapter of a new acsd. The number is higher than those before.
    [[nodiscard]] virtual std::unique_ptr<IRobotConnection> MakeConnection(
        std::uint64_t number,
        EventHandler handler) = 0;

    /// Whether acsd can reach it.
    virtual void SetReachable(bool bReachable) = 0;
    [[nodiscard]] virtual bool IsReachable() const = 0;

    /// Begins a random emergency stop, manual mode or error, until it recovers.
    virtual void Disturb() = 0;
    virtual void Recover() = 0;
    [[nodiscard]] virtual bool IsDisturbed() const = 0;
    /// Switches it off and on if it is on a node: it drops its drive and job and loses its memory.
    virtual void Forget() = 0;

    /// The operator has placed or removed a load.
    virtual void OnFloorChanged() = 0;

    /// From now on it rejects nothing, and no job fails.
    virtual void Calm() = 0;

    /// The last node that it was on.
    [[nodiscard]] virtual std::string GetNodeID() const = 0;
    /// Without a drive and a job, and not paused.
    [[nodiscard]] virtual bool IsAtRest() const = 0;
    /// A job runs without acsd, or its start may be in transit: the operator waits until its outcome is known.
    [[nodiscard]] virtual bool IsWorkUnderWay() const = 0;
};

} // namespace ACS::Simulation

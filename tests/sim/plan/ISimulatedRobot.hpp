#pragma once

#include "IRobotConnection.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace ACS::Simulation
{

/// A robot with a truth of its own, which lives on while acsd is down, and the way on which acsd reaches it.
class ISimulatedRobot
{
public:
    using EventHandler = std::function<void(const Planning::RobotEvent& event)>;

    ISimulatedRobot() = default;
    ISimulatedRobot(const ISimulatedRobot&) = delete;
    ISimulatedRobot& operator=(const ISimulatedRobot&) = delete;
    virtual ~ISimulatedRobot() = default;

    /// The adapter of a new acsd, whose number is higher than those before.
    [[nodiscard]] virtual std::unique_ptr<IRobotConnection> MakeConnection(
        std::uint64_t number,
        EventHandler handler) = 0;

    /// Whether acsd can reach it.
    virtual void SetReachable(bool bReachable) = 0;
    [[nodiscard]] virtual bool IsReachable() const = 0;

    /// Somebody presses its emergency stop, takes it in hand, or it has an error, until it recovers.
    virtual void Disturb() = 0;
    virtual void Recover() = 0;
    [[nodiscard]] virtual bool IsDisturbed() const = 0;
    /// It is switched off and on, where it stands on a node: what it was doing is given up, and it remembers nothing.
    virtual void Forget() = 0;

    /// People have put something on it or taken something off.
    virtual void OnFloorChanged() = 0;

    /// It refuses nothing, and no job fails, from now on.
    virtual void Calm() = 0;

    /// The last one that it was on.
    [[nodiscard]] virtual std::string GetNodeID() const = 0;
    /// Without a drive and a job, and not paused.
    [[nodiscard]] virtual bool IsAtRest() const = 0;
    /// A job runs on without acsd, or its start may still come: whoever looks waits until he can say what became of it.
    [[nodiscard]] virtual bool IsWorkUnderWay() const = 0;
};

} // namespace ACS::Simulation

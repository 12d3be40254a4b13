#pragma once

#include "control/TscControl.hpp"
#include "traffic/PlaceTracker.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Breaks cycles of robots that wait for one another: one takes a detour, retreats to its parking position or steps aside.
class DeadlockResolver
{
public:
    struct Round
    {
        bool bMoved = false;
        Robot* releasedOrNull = nullptr; ///< It yielded to another robot and is free to drive now.
    };

private:
    const SiteMap& _site;
    const PlanAdmission& _admission;
    const Fleet& _fleet;
    EngineTransaction& _transaction;
    const TscControl& _tsc;
    WaitingRobots& _waiting;
    TrafficCoordinator& _coordinator;
    const Traffic& _traffic;

public:
    DeadlockResolver(
        EngineState& engine,
        const TscControl& tsc,
        PlaceTracker& places,
        WaitingRobots& waiting,
        TrafficCoordinator& coordinator);

    [[nodiscard]] Round TryResolveDeadlock();

private:
    /// On to its aim around everybody who stands; home only where the whole way is open.
    [[nodiscard]] bool TryDetour(Robot& robot);
    /// One of those who keep the leader goes home first; where none can, the leader does, and else whoever stands idle steps
    /// aside.
    [[nodiscard]] bool TryMakeWay(Robot& leader, const std::vector<Robot*>& stuck);
    [[nodiscard]] bool TryRetreat(Robot& robot, const Robot& leader);
    /// A robot without work that stands at its home, or has none, in somebody's way: to the nearest station that nobody wants.
    [[nodiscard]] bool TryStepAside(Robot& robot, const Robot& leader);
};

} // namespace ACS::Planning

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

/// Breaks cycles of waiting robots: one takes a detour, retreats to its parking position or to a refuge, or moves aside. Owns no data.
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
    Traffic& _traffic;

public:
    DeadlockResolver(
        EngineState& engine,
        const TscControl& tsc,
        PlaceTracker& places,
        WaitingRobots& waiting,
        TrafficCoordinator& coordinator);

    /// Sets at most one robot in motion. The caller moves Round::releasedOrNull and calls again until nothing has moved.
    [[nodiscard]] Round TryResolveDeadlock();

private:
    /// Reroutes the robot around all stationary robots; home only if the whole route is open.
    [[nodiscard]] bool TryDetour(Robot& robot);
    /// One of the robots that block the leader retreats; else the leader does, or an idle robot moves aside.
    [[nodiscard]] bool TryMakeWay(Robot& leader, const std::vector<Robot*>& stuck);
    /// Sends the robot to its parking position or to a refuge until the leader has arrived.
    [[nodiscard]] bool TryRetreat(Robot& robot, const Robot& leader);
    [[nodiscard]] std::optional<PlannedRoute> PlanRetreatOrNull(const Robot& robot, const Robot& leader);
    /// Null where the robot cannot retreat to the target.
    [[nodiscard]] std::optional<PlannedRoute> PlanRetreatToOrNull(
        const Robot& robot,
        std::optional<std::size_t> targetOrNull) const;
    /// Sends an idle robot on the leader's route to the nearest station that no planned route uses.
    [[nodiscard]] bool TryStepAside(Robot& robot, const Robot& leader);
};

} // namespace ACS::Planning

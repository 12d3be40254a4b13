#pragma once

#include "control/TscControl.hpp"
#include "traffic/PlaceTracker.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Where each robot is to go, and which robots wait for which others.
class WaitingRobots
{
    const PlanAdmission& _admission;
    Fleet& _fleet;
    const TscControl& _tsc;
    const Traffic& _traffic;

public:
    WaitingRobots(EngineState& engine, const TscControl& tsc, PlaceTracker& places);

    [[nodiscard]] std::optional<std::size_t> GetTargetOrNull(const Robot& robot) const;
    /// Other robots that stand on the target, or drive to it. Nobody sets out for a place that another one has first: so
    /// who waits for a place waits at a place, and not on a lane.
    [[nodiscard]] std::vector<std::size_t> GetTargetHolders(const Robot& robot, std::size_t target) const;
    /// Whether the robot stands where its present step is done.
    [[nodiscard]] bool IsAtPlace(const Robot& robot) const;
    /// Robots that must get to a place and stand, in the order of their plans.
    [[nodiscard]] std::vector<Robot*> GetWaiting();
    /// Robots without work that stand elsewhere than at home.
    [[nodiscard]] std::vector<Robot*> ListAwayFromHome();
    /// Will do something without anybody else: it has nodes before it, or works, or is about to answer.
    [[nodiscard]] bool IsMoving(const Robot& robot) const;
    /// Wants to drive and cannot until others have moved.
    [[nodiscard]] bool IsWaiting(const Robot& robot) const;
    /// Who waits for robots that cannot move is not helped by others.
    [[nodiscard]] bool IsHelpable(const Robot& robot) const;
    [[nodiscard]] bool IsYielding(const Robot& robot) const;
    static void YieldTo(Robot& robot, const Robot& leader);
    /// Robots that wait, and wait for nobody who will do something by himself: the most urgent first.
    [[nodiscard]] std::vector<Robot*> ListDeadlocked();
    /// All that a robot waits for, and what those wait for in turn; the least urgent first.
    [[nodiscard]] std::vector<Robot*> GetBlockersOf(const Robot& start);
};

} // namespace ACS::Planning

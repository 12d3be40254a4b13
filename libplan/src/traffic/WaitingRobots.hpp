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

/// Decides where each robot drives next, which robots wait and for which others. Owns no data.
class WaitingRobots
{
    const PlanAdmission& _admission;
    Fleet& _fleet;
    const TscControl& _tsc;
    const Traffic& _traffic;

public:
    WaitingRobots(EngineState& engine, const TscControl& tsc, PlaceTracker& places);

    /// Node of the retreat, of the present step's station, or of the home.
    [[nodiscard]] std::optional<std::size_t> GetTargetOrNull(const Robot& robot) const;
    /// Other robots that occupy the target or drive to it. No drive starts while there are any, so a robot waits for a station
    /// at a station and not on a lane.
    [[nodiscard]] std::vector<std::size_t> GetTargetHolders(const Robot& robot, std::size_t target) const;
    /// Whether the robot is at the station of its present step.
    [[nodiscard]] bool IsAtPlace(const Robot& robot) const;
    /// Robots with a plan and without a drive that must reach a station, the most urgent first.
    [[nodiscard]] std::vector<Robot*> GetWaiting();
    /// Idle robots that are not at home.
    [[nodiscard]] std::vector<Robot*> ListAwayFromHome();
    /// Makes progress without other robots: it has granted nodes ahead, works, or has an unconfirmed drive.
    [[nodiscard]] bool IsMoving(const Robot& robot) const;
    /// Needs other robots to move before it can drive.
    [[nodiscard]] bool IsWaiting(const Robot& robot) const;
    /// Whether other robots can help: false if it waits only for robots that cannot move.
    [[nodiscard]] bool IsHelpable(const Robot& robot) const;
    /// Waits until the robot to which it yielded has arrived or can no longer move.
    [[nodiscard]] bool IsYielding(const Robot& robot) const;
    /// The robot does not start before the leader has arrived.
    static void YieldTo(Robot& robot, const Robot& leader);
    /// Robots that wait, directly or indirectly, for no robot that makes progress; the most urgent first.
    [[nodiscard]] std::vector<Robot*> ListDeadlocked();
    /// All robots for which this one waits, directly or indirectly; the least urgent first.
    [[nodiscard]] std::vector<Robot*> GetBlockersOf(const Robot& start);
    /// Whether one of all robots for which this one waits makes progress.
    [[nodiscard]] bool HasMovingBlocker(const Robot& start) const;
    /// Whether another robot is on the node, may enter it or drives to it.
    [[nodiscard]] bool IsTaken(std::size_t node, const Robot& robot) const;

private:
    /// By robot: whether the start waits for it, directly or indirectly.
    [[nodiscard]] std::vector<bool> MarkBlockersOf(const Robot& start) const;
};

} // namespace ACS::Planning

#pragma once

#include "control/ControlAnswers.hpp"
#include "traffic/DeadlockResolver.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include "work/PlanControls.hpp"
#include "work/PlanWork.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Moves robots, and handles what they report of their drives.
class DriveOutcomes
{
    const EngineOptions& _options;
    const SiteMap& _site;
    const Fleet& _fleet;
    EngineTransaction& _transaction;
    ControlAnswers& _answers;
    WaitingRobots& _waiting;
    TrafficCoordinator& _coordinator;
    DeadlockResolver _deadlocks;
    PlanWork& _work;
    PlanControls& _controls;

public:
    DriveOutcomes(
        EngineState& engine,
        TscControl& tsc,
        ControlAnswers& answers,
        PlaceTracker& places,
        WaitingRobots& waiting,
        TrafficCoordinator& coordinator,
        PlanWork& work,
        PlanControls& controls);

    /// Robots under way first, as they stand where others want to pass.
    void MoveWaiting();
    void SendIdleHome();
    /// Robots that only wait for one another would do so for ever. One at a time is set in motion, until each of them waits
    /// for one that moves.
    void ResolveDeadlocks();
    void OnNodePassed(Robot& robot, const NodePassed& event);
    void OnArrived(Robot& robot, const Arrived& event);
    void OnDriveRejected(Robot& robot, const DriveRejected& event);
    void OnDriveCancelled(Robot& robot, const DriveCancelled& event);

private:
    /// Whether the robot has begun to drive, or stands where it wants to be.
    [[nodiscard]] bool MoveRobot(Robot& robot);
    void OnNoRoute(Robot& robot, std::size_t target);
};

} // namespace ACS::Planning

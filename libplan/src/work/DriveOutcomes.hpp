#pragma once

#include "control/ControlAnswers.hpp"
#include "control/RejectionWatch.hpp"
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
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Owns the DeadlockResolver. Starts drives, and handles what robots report of them.
class DriveOutcomes
{
    const EngineOptions& _options;
    const SiteMap& _site;
    const Fleet& _fleet;
    EngineTransaction& _transaction;
    ControlAnswers& _answers;
    RejectionWatch& _rejections;
    WaitingRobots& _waiting;
    TrafficCoordinator& _coordinator;
    DeadlockResolver _deadlocks;
    PlanAssignment& _assignment;
    PlanWork& _work;
    PlanControls& _controls;

public:
    DriveOutcomes(
        EngineState& engine,
        TscControl& tsc,
        ControlAnswers& answers,
        RejectionWatch& rejections,
        PlaceTracker& places,
        WaitingRobots& waiting,
        TrafficCoordinator& coordinator,
        PlanWork& work,
        PlanControls& controls);

    /// Extends drives first, because their robots are on lanes; then starts robots with a plan.
    void MoveWaiting();
    /// Starts idle robots towards their homes.
    void SendIdleHome();
    /// Sets one robot at a time in motion until each waiting robot waits for one that makes progress.
    void ResolveDeadlocks();
    void OnNodePassed(Robot& robot, const NodePassed& event);
    void OnArrived(Robot& robot, const Arrived& event);
    void OnDriveRejected(Robot& robot, const DriveRejected& event);
    void OnDriveCancelled(Robot& robot, const DriveCancelled& event);

private:
    /// Tries to drive, and begins the work or fails the plan. Returns whether the robot drives or is at its target.
    [[nodiscard]] bool TryMove(Robot& robot);
    void OnNoRoute(Robot& robot, std::size_t target);
    /// The robot has entered a node that another robot has reserved: its plan fails, and its place is unknown.
    void OnNodeOfOther(Robot& robot);
    /// Ends the drive, and the plan that is to be cancelled or aborted. Returns the plan that continues; null if there is none.
    [[nodiscard]] ActivePlan* EndFailedDriveOrNull(Robot& robot, std::string_view reason);
};

} // namespace ACS::Planning

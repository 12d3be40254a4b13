#pragma once

#include "control/ChargingControl.hpp"
#include "control/ControlAnswers.hpp"
#include "traffic/PlaceTracker.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include <acs/plan/Router.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

enum class EDriveAttempt : std::uint8_t
{
    Waits,
    Begun,
    AtTarget,
    NoRoute,
};

/// Plans routes, begins drives, extends their base, reroutes and ends them.
class TrafficCoordinator
{
    const EngineOptions& _options;
    const SiteMap& _site;
    Core::IRandom& _random;
    const PlanAdmission& _admission;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    ControlAnswers& _answers;
    ChargingControl& _charging;
    PlaceTracker& _places;
    const WaitingRobots& _waiting;
    Router _router;
    Traffic& _traffic;

public:
    TrafficCoordinator(
        EngineState& engine,
        ControlAnswers& answers,
        ChargingControl& charging,
        PlaceTracker& places,
        const WaitingRobots& waiting);

    /// The parking position of a robot without a home is the first free station beside the lanes with a route there and back. The
    /// robot goes there only to make way.
    void AssignParking();
    [[nodiscard]] const Router& GetRouter() const noexcept;
    /// The vehicle has had its time to report its drive.
    void OnExtensionDue(Robot& robot);
    void OnHomeRetry(Robot& robot);
    void ExtendDrives();
    /// Keeps the base ahead of the robot. Longer than asked for, so that not every node costs an update.
    void ExtendBase(Robot& robot);
    [[nodiscard]] EDriveAttempt TryDrive(Robot& robot);
    [[nodiscard]] std::optional<PlannedRoute> PlanRouteOrNull(
        const Robot& robot,
        std::size_t target,
        const Router::NodeFilter& isExcluded) const;
    /// Begun with the first nodes that are granted; without any it is not begun.
    [[nodiscard]] bool TryBeginDrive(Robot& robot, const PlannedRoute& plannedRoute);
    /// Sent home again later, each time twice as late: one that stands between two nodes refuses until somebody comes.
    void RefuseHome(Robot& robot);
    /// Whether those that cannot move leave it a way to all places of the plan and from each of them home.
    [[nodiscard]] bool CanServe(const Robot& robot, const ActivePlan& plan) const;
    /// Another way than the one that it is on: granted now, driven when the vehicle has given the present one up.
    [[nodiscard]] bool TryReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    /// The vehicle has given its drive up for this.
    void BeginReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    /// The vehicle has not given its drive up in time: it stays on it.
    void AbandonReroute(Robot& robot);
    /// The robot is at or beyond this node of its way: what lies behind is free for others. False: another robot holds the
    /// node, as this one drove on without leave.
    [[nodiscard]] bool TryAdvance(Robot& robot, std::size_t routeIndex);
    /// The robot stands on drive->passed, or between it and the next node: nothing else of the way is its own any more.
    void EndDrive(Robot& robot);

private:
    [[nodiscard]] bool CanParkAt(const RobotOptions& robot, std::size_t dock) const;
    /// Around those who stand in the way and have no reason to leave soon, where there is a way around them.
    [[nodiscard]] bool TryBeginPlannedRoute(Robot& robot);
    [[nodiscard]] bool TryPlanRoute(Robot& robot, std::size_t target);
};

} // namespace ACS::Planning

#pragma once

#include "control/ChargingControl.hpp"
#include "control/ControlAnswers.hpp"
#include "traffic/PlaceTracker.hpp"
#include "traffic/RoutePlanner.hpp"
#include "traffic/VisitForecast.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include <acs/plan/Router.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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

/// Owns the RoutePlanner. Begins and ends drives, extends their base and reroutes them.
class TrafficCoordinator
{
    const EngineOptions& _options;
    const SiteMap& _site;
    Core::IRandom& _random;
    const PlanAdmission& _admission;
    const BlockBook& _blocks;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    ControlAnswers& _answers;
    ChargingControl& _charging;
    PlaceTracker& _places;
    const WaitingRobots& _waiting;
    RoutePlanner _routes;
    VisitForecast _visits;
    Traffic& _traffic;
    bool _bStandIns = false; ///< Robots may have them.

public:
    TrafficCoordinator(
        EngineState& engine,
        ControlAnswers& answers,
        ChargingControl& charging,
        PlaceTracker& places,
        const WaitingRobots& waiting);

    /// Chooses the parking positions. Without a home it is the first free station beside the lanes with a route there and back,
    /// used only to clear the routes of others.
    void AssignParking();
    [[nodiscard]] const VisitForecast& GetVisits() const noexcept;
    /// Of the map, as if nothing was blocked.
    [[nodiscard]] const Router& GetRouter() const noexcept;
    /// Around the blocks.
    [[nodiscard]] const Router& GetOpenRouter() const noexcept;
    /// Blocks were added or removed: routes are planned again.
    void OnBlocksChanged();
    /// Chooses another parking position for each robot whose way to its own is blocked.
    void UpdateStandIns();
    /// Reroutes the robots whose base ends before a block. One that finds no way does not wait on a lane.
    void AvoidBlocks();
    /// The block of the robot's target.
    [[nodiscard]] const Block* FindTargetBlockOrNull(const Robot& robot, std::size_t target) const;
    /// Whether neither the node nor a station that has it is blocked.
    [[nodiscard]] bool IsOpenDock(std::size_t node) const;
    /// Why the robot cannot execute the plan while there are these blocks.
    [[nodiscard]] std::optional<std::string> DescribeBlockOrNull(const Robot& robot, const ActivePlan& plan) const;
    /// The time to confirm a drive has expired: the base is extended anyway.
    void OnExtensionDue(Robot& robot);
    /// The robot may be sent to its parking position again.
    void OnHomeRetry(Robot& robot);
    /// Grants further nodes to all drives, the most urgent first.
    void ExtendDrives();
    /// Grants and releases further nodes; twice the base length, so that not every node costs an order update.
    void ExtendBase(Robot& robot);
    /// Begins a drive to the robot's target if its route is free. Returns what the caller must do next.
    [[nodiscard]] EDriveAttempt TryDrive(Robot& robot);
    /// RoutePlanner::PlanRouteOrNull.
    [[nodiscard]] std::optional<PlannedRoute> PlanRouteOrNull(
        const Robot& robot,
        std::size_t target,
        const Router::NodeFilter& isExcluded) const;
    /// Begins the drive with the nodes that are granted; false if there are none.
    [[nodiscard]] bool TryBeginDrive(Robot& robot, const PlannedRoute& plannedRoute);
    /// Delays the next attempt to send the robot home, twice as long each time: a robot between two nodes refuses each one.
    /// The reason is that of its status until then.
    void RefuseHome(Robot& robot, std::string reason);
    /// Whether robots that cannot move leave free a route to each station of the plan and from there home.
    [[nodiscard]] bool CanServe(const Robot& robot, const ActivePlan& plan) const;
    /// Cancels the drive for another route, whose first nodes are granted now.
    [[nodiscard]] bool TryReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    /// The vehicle has cancelled its drive: begins the new route.
    void BeginReroute(Robot& robot, PlannedRoute plannedRoute, bool bRetreats);
    /// The vehicle has not cancelled its drive in time: the drive continues.
    void AbandonReroute(Robot& robot);
    /// The robot has reached this node of its route: frees the nodes before it. False: the robot entered a node that another
    /// robot has reserved.
    [[nodiscard]] bool TryAdvance(Robot& robot, std::size_t routeIndex);
    /// Reserves the node that a robot that has confirmed its drive reports, also without a grant. Raises an alarm while that node
    /// is off its route. It is granted no further nodes then.
    void VerifyRoute(Robot& robot);
    /// The robot is stationary: on the node that its last state reports, or else on the node that it passed last, or after it.
    /// Frees the rest of the route.
    void EndDrive(Robot& robot);

private:
    /// Of the robots that are on the target or drive there, those that will still be there when the robot arrives.
    [[nodiscard]] std::vector<std::size_t> ListLasting(const Robot& robot, std::size_t target) const;
    /// Traffic::Extend, but does not close the way of a robot that is on the target: it waits before.
    [[nodiscard]] std::size_t Extend(Robot& robot, std::span<const std::size_t> ahead, std::size_t target);
    [[nodiscard]] std::optional<std::size_t> ChooseStandInOrNull(const Robot& robot) const;
    /// Whether the robot can park there: nothing on the way is blocked.
    [[nodiscard]] bool IsParkingOpen(const Robot& robot, std::size_t node) const;
    [[nodiscard]] bool IsParkingTaken(const Robot& robot, std::size_t node) const;
    /// The first block of what is not granted of its drive.
    [[nodiscard]] const Block* FindDriveBlockOrNull(const Robot& robot) const;
    /// Whether a block is why the base of its drive is not extended.
    [[nodiscard]] bool IsStoppedByBlock(const Robot& robot) const;
    void AvoidBlock(Robot& robot);
    /// Notes what is blocked on the way of a robot without a drive; false: nothing.
    [[nodiscard]] bool TryNoteBlock(Robot& robot, std::size_t target) const;
    /// Notes why the robot is granted nothing; empty: not because of blocks or its load.
    static void NoteBlock(Robot& robot, std::string block);
    /// Grants further nodes of its drive, which has some that are not granted.
    void GrantFurther(Robot& robot);
    /// The load of the robot closes the next edge of its drive. Notes it, unless the robot can be rerouted: others clear that
    /// route. The load may change at any time: the robot is asked again at the next dispatch.
    void NoteClosedEdge(Robot& robot) const;
    /// Sends a robot that waits for a block on a lane to its parking position.
    [[nodiscard]] bool TryLeaveLane(Robot& robot);
    [[nodiscard]] std::optional<PlannedRoute> PlanWayOffLaneOrNull(const Robot& robot) const;
    [[nodiscard]] std::optional<std::size_t> FindParkingOrNull(
        const RobotOptions& robot,
        const std::vector<bool>& taken) const;
    [[nodiscard]] bool CanParkAt(const RobotOptions& robot, std::size_t dock) const;
    /// Whether the robot has reported another node since it passed the last one of its drive.
    [[nodiscard]] static bool IsReportedElsewhere(const Robot& robot);
    /// The robot is on this node, which may be another one than was granted: no other robot is sent there. nullopt: on a granted
    /// one.
    void HoldStray(Robot& robot, std::optional<std::size_t> nodeOrNull);
    /// Begins the planned route, or a detour around stationary robots if there is one.
    [[nodiscard]] bool TryBeginPlannedRoute(Robot& robot);
};

} // namespace ACS::Planning

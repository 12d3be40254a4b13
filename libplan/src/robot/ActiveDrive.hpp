#pragma once

#include <acs/plan/ELoad.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

enum class EDriveGoal : std::uint8_t
{
    Step,
    Home,
};

enum class ECancellation : std::uint8_t
{
    None,
    Awaited, ///< The robot was commanded to cancel the drive.
    Late,    ///< The time limit has expired; the robot may still cancel the drive.
};

/// The route that a robot is to drive next.
struct PlannedRoute
{
    std::size_t target = 0;
    ELoad load = ELoad::Unknown; ///< With which the robot may drive it.
    Route route;
    std::vector<std::size_t> nodes; ///< Of the route, by index in the map.
};

/// A drive is cancelled for this route. The first nodes of it are granted.
struct Reroute
{
    PlannedRoute route;
    bool bRetreats = false;
};

/// A drive from its command to its end.
struct ActiveDrive
{
    std::string driveID;
    ELoad load = ELoad::Unknown; ///< Of the robot when the route was planned.
    Route route;
    std::vector<std::size_t> nodes; ///< Of the route, by index in the map.
    std::size_t grantedCount = 0;   ///< Nodes from the start that are or were granted.
    std::size_t releasedCount = 0;  ///< Of them, those released to the robot.
    std::size_t passed = 0;         ///< Index in the route of the last node passed.
    EDriveGoal goal = EDriveGoal::Step;
    bool bConfirmed = false;
    bool bTaken = false;     ///< The robot has confirmed the drive.
    bool bLeftRoute = false; ///< The robot reports a node that the route does not have.
    bool bOverran = false;   ///< The robot entered a node that another one holds.
    bool bReported = false;  ///< A state of the robot has followed the node passed last.
    ECancellation cancellation = ECancellation::None;
    std::optional<Reroute> reroute;

    [[nodiscard]] bool IsCancelling() const noexcept;
    void StopAwaitingCancellation() noexcept;
    /// The robot is on the last node of its base, and the route continues.
    [[nodiscard]] bool IsAtBaseEnd() const noexcept;
    /// The last node before the target is passed.
    [[nodiscard]] bool IsApproaching() const noexcept;
    /// Nodes from the start that a vehicle of the type may reach with this load; at least the granted ones.
    [[nodiscard]] std::size_t CountReachable(const SiteMap& site, std::string_view vehicleTypeID, ELoad present) const;
    /// The node after the last one passed, at most the last node.
    [[nodiscard]] const std::string& GetNextNodeID() const;
};

} // namespace ACS::Planning

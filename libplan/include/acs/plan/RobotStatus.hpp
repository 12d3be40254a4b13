#pragma once

#include <acs/plan/ERobotStatus.hpp>
#include <acs/plan/ERobotType.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// The content of RobotStatusUpdate (section 6.16 of MCS-ACS).
struct RobotStatus
{
    std::string robotID;
    ERobotType type = ERobotType::LR;
    ERobotStatus status = ERobotStatus::Disconnected;
    std::string position;                               ///< The last confirmed station; empty: unknown.
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port, in the order of RobotOptions::ports.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::string message;         ///< Why the robot makes no progress, for example what it waits for; may be empty.
    bool bInMaintenance = false; ///< Not a member of RobotStatusUpdate; the message mentions it.

    bool operator==(const RobotStatus&) const = default;
};

/// The content of RobotPositionUpdate (section 6.19). Exists only once the robot has reported its position.
struct RobotPose
{
    std::string robotID;
    double x = 0;              ///< Metres.
    double y = 0;              ///< Metres.
    double theta = 0;          ///< Radians.
    double batteryPercent = 0; ///< 0 to 100.

    bool operator==(const RobotPose&) const = default;
};

/// What no message to the MCS shows.
struct RobotDetail
{
    std::string robotID;
    std::string nodeID;                    ///< The node it is on or has passed last; empty: unknown.
    std::optional<std::string> nextNodeID; ///< The node to which it is on the way; nullopt: it is on nodeID.
    bool bHasDrive = false;                ///< Of its plan, or to its parking position.
    bool bHasJob = false;                  ///< Also one whose plan has ended.

    bool operator==(const RobotDetail&) const = default;
};

/// A node of the rest of a route.
struct RouteNodeAhead
{
    std::string nodeID;
    bool bReserved = false; ///< The robot may drive there now; false: the node is not granted yet.

    bool operator==(const RouteNodeAhead&) const = default;
};

/// Where a robot drives, and the nodes that no other robot may use.
struct RobotRoute
{
    std::string robotID;
    /// The rest of its drive in driving order, without the node it is on or has passed last; empty: it has no drive.
    std::vector<RouteNodeAhead> nodes;
    /// Its node, the reserved nodes of its route in driving order, then other nodes where it may be.
    std::vector<std::string> reservedNodeIDs;

    bool operator==(const RobotRoute&) const = default;
};

} // namespace ACS::Planning

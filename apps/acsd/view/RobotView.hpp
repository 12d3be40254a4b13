#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Metres and radians, rounded to millimetres and milliradians.
struct PoseView
{
    double x = 0;
    double y = 0;
    double theta = 0;

    bool operator==(const PoseView&) const = default;
};

struct RouteNodeView
{
    std::string nodeID;
    bool bReserved = false; ///< The robot may drive there now.

    bool operator==(const RouteNodeView&) const = default;
};

/// An error that the robot reports.
struct RobotErrorView
{
    std::string type;
    std::string level;
    std::string description;

    bool operator==(const RobotErrorView&) const = default;
};

/// A robot, as the operator sees it.
struct RobotView
{
    std::string robotID;
    std::string type;
    std::string driver;
    std::string status;
    std::string position;                  ///< The last confirmed station; empty: unknown.
    std::optional<std::string> nodeID;     ///< The node it is on or has passed last.
    std::optional<std::string> nextNodeID; ///< The node to which it is on the way.
    std::optional<PoseView> pose;          ///< nullopt until the robot has reported it.
    std::optional<std::int64_t> battery;   ///< Percent.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::vector<RouteNodeView> route; ///< Of its drive, what is left, in driving order.
    std::vector<std::string> reservedNodeIDs;
    std::vector<std::string> ports;
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port.
    bool bInMaintenance = false;
    std::optional<std::string> reason;          ///< Why a robot without a plan is not available.
    std::optional<bool> bArmUp;                 ///< nullopt without an arm.
    std::optional<std::string> topic;           ///< The begin of its MQTT topics.
    std::optional<std::string> protocolVersion; ///< As the robot reports it.
    std::optional<std::string> mode;            ///< As the robot reports it.
    std::vector<RobotErrorView> errors;
    std::vector<std::string> warnings; ///< What its messages contradict, without an alarm.
    std::optional<Core::WallTime> lastMessageAt;

    bool operator==(const RobotView&) const = default;
};

} // namespace ACS::Acsd

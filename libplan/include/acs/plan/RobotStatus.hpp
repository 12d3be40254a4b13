#pragma once

#include <acs/plan/ERobotStatus.hpp>
#include <acs/plan/ERobotType.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// What RobotStatusUpdate says of a robot (section 5.9 of MCS-ACS).
struct RobotStatus
{
    std::string robotID;
    ERobotType type = ERobotType::LR;
    ERobotStatus status = ERobotStatus::Disconnected;
    std::string position;                               ///< The last confirmed station; empty where none is known.
    std::vector<std::optional<std::string>> carrierIDs; ///< One per port, in the order of RobotOptions::ports.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    std::string message;         ///< Why the robot does not do more, such as what it waits for; may be empty.
    bool bInMaintenance = false; ///< Not told to the MCS but by the message.

    bool operator==(const RobotStatus&) const = default;
};

/// What RobotPositionUpdate says of a robot (section 5.10); only once the robot has told its position.
struct RobotPose
{
    std::string robotID;
    double x = 0;              ///< Metres.
    double y = 0;              ///< Metres.
    double theta = 0;          ///< Radians.
    double batteryPercent = 0; ///< 0 to 100.

    bool operator==(const RobotPose&) const = default;
};

} // namespace ACS::Planning

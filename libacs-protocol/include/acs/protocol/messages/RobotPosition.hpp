#pragma once

#include <string>
#include <vector>

namespace ACS::Protocol
{

/// Where a robot is (section 6.19). The document states no units; these are the ones of its examples.
struct RobotPosition
{
    std::string robotID;
    double x = 0.0;       ///< Metres.
    double y = 0.0;       ///< Metres.
    double angle = 0.0;   ///< Degrees, 0 to below 360.
    double battery = 0.0; ///< Percent; send whole numbers, an MCS exists that reads nothing else.

    bool operator==(const RobotPosition&) const = default;
};

/// ACS to MCS, every 200 ms, all robots in one message, the only command without an Ack (section 6.19).
struct RobotPositionUpdate
{
    std::vector<RobotPosition> robots;

    bool operator==(const RobotPositionUpdate&) const = default;
};

} // namespace ACS::Protocol

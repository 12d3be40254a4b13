#pragma once

#include <acs/protocol/messages/RobotPosition.hpp>
#include <acs/protocol/messages/RobotStatus.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// What is known about one robot: its last status and its last position. Either may be missing.
struct RobotEntry
{
    std::optional<Protocol::RobotStatusUpdate> status;
    std::optional<Protocol::RobotPosition> position;
};

/// All robots that the ACS ever told about. Pure.
class RobotBoard
{
    std::map<std::string, RobotEntry> _robots;

public:
    /// Appends a line for people where status, place, load or message changed.
    void OnStatus(const Protocol::RobotStatusUpdate& update, std::vector<std::string>& out);

    /// Never a line: there are five a second.
    void OnPosition(const Protocol::RobotPositionUpdate& update);

    /// By name.
    [[nodiscard]] const std::map<std::string, RobotEntry>& GetRobots() const noexcept;
};

/// "TRAY_01 – TRAY_03": what stands on the robot, a dash for an empty port.
[[nodiscard]] std::string DescribeCarriers(const Protocol::RobotStatusUpdate& status);

} // namespace ACS::McsSim

#pragma once

#include "plans/PlanTracker.hpp"
#include <acs/protocol/messages/RobotPosition.hpp>
#include <acs/protocol/messages/RobotStatus.hpp>

#include <cstddef>
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

/// All robots that the ACS has reported. Pure.
class RobotBoard
{
public:
    /// Of more robots nothing is kept.
    static constexpr std::size_t MAX_ROBOTS = PlanTracker::MAX_ROBOTS;

private:
    std::map<std::string, RobotEntry> _robots;
    bool _bFullTold = false;

public:
    /// Appends a line for people where status, place, load or message changed.
    void OnStatus(const Protocol::RobotStatusUpdate& update, std::vector<std::string>& out);

    /// Never a line but for too many robots: there are five a second.
    void OnPosition(const Protocol::RobotPositionUpdate& update, std::vector<std::string>& out);

    /// By name.
    [[nodiscard]] const std::map<std::string, RobotEntry>& GetRobots() const noexcept;

private:
    /// Null where there is no room for one more.
    [[nodiscard]] RobotEntry* TakeEntryOrNull(const std::string& robotID, std::vector<std::string>& out);
};

/// "TRAY_01 – TRAY_03": the carriers on the robot, a dash for an empty port.
[[nodiscard]] std::string DescribeCarriers(const Protocol::RobotStatusUpdate& status);

} // namespace ACS::McsSim

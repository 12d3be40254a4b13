#include "RobotBoard.hpp"

#include "CleanText.hpp"

#include <fmt/format.h>

namespace ACS::McsSim
{

namespace
{

bool IsSameForPeople(const Protocol::RobotStatusUpdate& left, const Protocol::RobotStatusUpdate& right)
{
    return left.robotStatus == right.robotStatus && left.position == right.position
        && left.carrierIDs == right.carrierIDs && left.message == right.message;
}

} // namespace

void RobotBoard::OnStatus(const Protocol::RobotStatusUpdate& update, std::vector<std::string>& out)
{
    RobotEntry& robot = _robots[update.robotID];
    const bool bChanged = !robot.status.has_value() || !IsSameForPeople(*robot.status, update);
    robot.status = update;
    if (!bChanged)
    {
        return;
    }
    std::string line = fmt::format("{} RobotStatusUpdate {}", CleanText(update.robotID), GetText(update.robotStatus));
    line += update.position.has_value() ? " at " + CleanText(*update.position) : "";
    line += update.carrierIDs.empty() ? "" : " [" + DescribeCarriers(update) + "]";
    line += update.message.empty() ? "" : ": " + CleanText(update.message);
    out.push_back(std::move(line));
}

void RobotBoard::OnPosition(const Protocol::RobotPositionUpdate& update)
{
    for (const Protocol::RobotPosition& position : update.robots)
    {
        _robots[position.robotID].position = position;
    }
}

const std::map<std::string, RobotEntry>& RobotBoard::GetRobots() const noexcept
{
    return _robots;
}

std::string DescribeCarriers(const Protocol::RobotStatusUpdate& status)
{
    std::string text;
    for (const std::optional<std::string>& carrierID : status.carrierIDs)
    {
        text += text.empty() ? "" : " ";
        text += carrierID.has_value() && !carrierID->empty() ? CleanText(*carrierID) : "–";
    }
    return text;
}

} // namespace ACS::McsSim

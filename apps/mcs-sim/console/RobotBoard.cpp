#include "console/RobotBoard.hpp"

#include "console/CleanText.hpp"

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
    RobotEntry* const robotOrNull = TakeEntryOrNull(update.robotID, out);
    if (robotOrNull == nullptr)
    {
        return;
    }
    const bool bChanged = !robotOrNull->status.has_value() || !IsSameForPeople(*robotOrNull->status, update);
    robotOrNull->status = update;
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

void RobotBoard::OnPosition(const Protocol::RobotPositionUpdate& update, std::vector<std::string>& out)
{
    for (const Protocol::RobotPosition& position : update.robots)
    {
        RobotEntry* const robotOrNull = TakeEntryOrNull(position.robotID, out);
        if (robotOrNull != nullptr)
        {
            robotOrNull->position = position;
        }
    }
}

const std::map<std::string, RobotEntry>& RobotBoard::GetRobots() const noexcept
{
    return _robots;
}

RobotEntry* RobotBoard::TakeEntryOrNull(const std::string& robotID, std::vector<std::string>& out)
{
    const auto found = _robots.find(robotID);
    if (found != _robots.end() || _robots.size() < MAX_ROBOTS)
    {
        return found != _robots.end() ? &found->second : &_robots[robotID];
    }
    if (!_bFullTold)
    {
        _bFullTold = true;
        out.push_back(fmt::format("ACS has more than {} robots: nothing is kept of the others", MAX_ROBOTS));
    }
    return nullptr;
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

#include "PlanEngine.Impl.hpp"
#include <acs/core/ControlCharacter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

namespace
{

std::string DescribePorts(const std::vector<std::optional<std::string>>& carriers)
{
    std::string text;
    for (const std::optional<std::string>& carrier : carriers)
    {
        text += (text.empty() ? "" : ", ") + carrier.value_or("empty");
    }
    return text;
}

} // namespace

void PlanEngine::Impl::Reply(ReplyToken token, bool bAccepted, std::string message)
{
    _actions.emplace_back(ReplyCommand{token, bAccepted, std::move(message)});
}

PlanEngine::Impl::Robot* PlanEngine::Impl::FindRobotOrNull(std::string_view robotID)
{
    const auto found = _robotIndices.find(robotID);
    return found == _robotIndices.end() ? nullptr : &_robots[found->second];
}

void PlanEngine::Impl::Maintain(const SetMaintenance& command)
{
    Robot* robotOrNull = FindRobotOrNull(command.robotID);
    if (robotOrNull == nullptr)
    {
        Reply(command.replyToken, false, fmt::format("There is no robot {}.", command.robotID));
        return;
    }
    Robot& robot = *robotOrNull;
    if (std::exchange(robot.bInMaintenance, command.bOn) != command.bOn)
    {
        _changes.emplace_back(MaintenanceChanged{command.robotID, command.bOn});
        robot.bTouched = true;
        _bDispatchNeeded = true;
        Note(robot, command.bOn ? "is taken out of service" : "is in service again");
    }
    if (command.bOn && !robot.bPlaced && !robot.supposedNodes.empty())
    {
        ForgetSupposed(robot);
        Note(robot, "is not on the floor: where it was is free again");
    }
    const bool bEndsPlan = command.bOn && robot.planOrNull != nullptr;
    Reply(
        command.replyToken,
        true,
        fmt::format(
            "{} is {}{}.",
            command.robotID,
            command.bOn ? "in maintenance" : "in service",
            bEndsPlan ? " after plan " + robot.planOrNull->record.plan.planID : ""));
}

/// Whether what it tells of lasts, as far as the engine knows.
bool PlanEngine::Impl::HasCause(const Alarm& alarm) const
{
    if (alarm.errorCode == ALARM_STORE)
    {
        return _bStoreFailing;
    }
    const auto found = _robotIndices.find(alarm.robotID);
    if (found == _robotIndices.end())
    {
        return false;
    }
    const Robot& robot = _robots[found->second];
    if (alarm.errorCode == ALARM_LINK_LOST)
    {
        return !robot.bOnline;
    }
    if (alarm.errorCode == ALARM_PLACE)
    {
        return robot.bOnline && !robot.bPlaced;
    }
    if (alarm.errorCode == ALARM_UNCERTAIN)
    {
        return robot.bUncertain;
    }
    if (alarm.errorCode == ALARM_STALL)
    {
        return robot.bStalled;
    }
    return robot.state.has_value()
        && std::ranges::count(robot.state->errors, alarm.errorCode, &RobotError::errorCode) > 0;
}

void PlanEngine::Impl::ClearByOperator(const ClearAlarms& command)
{
    std::vector<Alarm> cleared;
    std::ranges::copy_if(_alarms, std::back_inserter(cleared), [&command](const Alarm& alarm) {
        return alarm.robotID == command.robotID && alarm.errorCode == command.errorCode
            && (!command.planID.has_value() || alarm.planID == command.planID)
            && (!command.jobID.has_value() || alarm.jobID == command.jobID);
    });
    if (cleared.empty())
    {
        Reply(command.replyToken, false, fmt::format("{} has no alarm {}.", command.robotID, command.errorCode));
        return;
    }
    std::size_t lasting = 0;
    for (const Alarm& alarm : cleared)
    {
        ClearAlarm(alarm);
        if (HasCause(alarm))
        {
            ++lasting;
            RaiseAlarm(alarm);
        }
    }
    Reply(
        command.replyToken,
        true,
        fmt::format("{} cleared; {} set again, as the cause is still there.", cleared.size(), lasting));
}

/// Why these cannot be what is on the robot's ports.
std::optional<std::string> PlanEngine::Impl::GetObjectionOrNull(const SetCarriers& command) const
{
    const auto index = _robotIndices.find(command.robotID);
    if (index == _robotIndices.end())
    {
        return fmt::format("There is no robot {}.", command.robotID);
    }
    const Robot& robot = _robots[index->second];
    if (command.carrierIDs.size() != robot.carriers.size())
    {
        return fmt::format(
            "{} has {} carrier ports, and {} carriers were given; one for each port, empty for none.",
            command.robotID,
            robot.carriers.size(),
            command.carrierIDs.size());
    }
    for (const std::optional<std::string>& carrier : command.carrierIDs)
    {
        if (!carrier.has_value() || *carrier == UNKNOWN_CARRIER)
        {
            continue;
        }
        if (carrier->empty() || carrier->size() > MAXIMUM_ID_LENGTH)
        {
            return fmt::format("A carrierId has 1 to {} bytes.", MAXIMUM_ID_LENGTH);
        }
        if (Core::HasControlCharacter(*carrier))
        {
            return std::string("A carrierId has no control characters.");
        }
        if (std::ranges::count(command.carrierIDs, carrier) > 1)
        {
            return fmt::format("{} cannot be on two ports.", *carrier);
        }
        for (const Robot& other : _robots)
        {
            if (&other != &robot && std::ranges::count(other.carriers, carrier) > 0)
            {
                return fmt::format("{} is on {}; correct that robot's ports first.", *carrier, GetRobotID(other));
            }
        }
    }
    return std::nullopt;
}

void PlanEngine::Impl::CorrectCarriers(const SetCarriers& command)
{
    if (std::optional<std::string> objection = GetObjectionOrNull(command))
    {
        Reply(command.replyToken, false, std::move(*objection));
        return;
    }
    Robot& robot = *FindRobotOrNull(command.robotID);
    Note(
        robot,
        fmt::format(
            "its ports were corrected by an operator, from {} to {}",
            DescribePorts(robot.carriers),
            DescribePorts(command.carrierIDs)));
    robot.carriers = command.carrierIDs;
    robot.bTouched = true;
    _bDispatchNeeded = true;
    _changes.emplace_back(CarriersChanged{command.robotID, robot.carriers});
    Alarm mismatch;
    mismatch.robotID = command.robotID;
    mismatch.errorCode = ALARM_PORT;
    ClearAlarm(mismatch);
    Reply(command.replyToken, true, fmt::format("The ports of {} are corrected.", command.robotID));
}

} // namespace ACS::Planning

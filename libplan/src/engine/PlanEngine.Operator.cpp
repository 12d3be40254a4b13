#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

namespace
{

std::string DescribePorts(const CarrierIDs& carriers)
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
    if (command.bOn && !robot.bPlaced && !robot.possibleNodes.empty())
    {
        ForgetPossibleNodes(robot);
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
        return _backlog.IsFailing();
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
    if (alarm.errorCode == ALARM_UNRESOLVED)
    {
        return robot.job.IsUnresolved();
    }
    if (alarm.errorCode == ALARM_STALL)
    {
        return robot.stall.IsStalled();
    }
    return robot.state.has_value()
        && std::ranges::count(robot.state->errors, alarm.errorCode, &RobotError::errorCode) > 0;
}

void PlanEngine::Impl::ClearByOperator(const ClearAlarms& command)
{
    const std::vector<ErrorReport> cleared = _alarms.ClearIf([&command](const Alarm& alarm) {
        return alarm.robotID == command.robotID && alarm.errorCode == command.errorCode
            && (!command.planID.has_value() || alarm.planID == command.planID)
            && (!command.jobID.has_value() || alarm.jobID == command.jobID);
    });
    if (cleared.empty())
    {
        Reply(command.replyToken, false, fmt::format("{} has no alarm {}.", command.robotID, command.errorCode));
        return;
    }
    if (Robot* robotOrNull = FindRobotOrNull(command.robotID);
        robotOrNull != nullptr && command.errorCode == ALARM_LOADS)
    {
        robotOrNull->ports.ForgetDisputes(); // the record has followed the robot already
    }
    std::size_t lasting = 0;
    for (const ErrorReport& report : cleared)
    {
        ReportAlarms({report});
        if (HasCause(report.alarm))
        {
            ++lasting;
            RaiseAlarm(report.alarm);
        }
    }
    Reply(
        command.replyToken,
        true,
        fmt::format("{} cleared; {} set again, as the cause is still there.", cleared.size(), lasting));
}

/// Why these cannot be what is on the robot's ports.
std::optional<std::string> PlanEngine::Impl::GetRejectionReasonOrNull(const SetCarriers& command) const
{
    const auto index = _robotIndices.find(command.robotID);
    if (index == _robotIndices.end())
    {
        return fmt::format("There is no robot {}.", command.robotID);
    }
    const Robot& robot = _robots[index->second];
    if (command.carrierIDs.size() != robot.ports.GetCarriers().size())
    {
        return fmt::format(
            "{} has {} carrier ports, and {} carriers were given; one for each port, empty for none.",
            command.robotID,
            robot.ports.GetCarriers().size(),
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
            if (&other != &robot && other.ports.FindCarrierOrNull(*carrier).has_value())
            {
                return fmt::format("{} is on {}; correct that robot's ports first.", *carrier, GetRobotID(other));
            }
        }
    }
    return std::nullopt;
}

void PlanEngine::Impl::CorrectCarriers(const SetCarriers& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    Robot& robot = *FindRobotOrNull(command.robotID);
    Note(
        robot,
        fmt::format(
            "its ports were corrected by an operator, from {} to {}",
            DescribePorts(robot.ports.GetCarriers()),
            DescribePorts(command.carrierIDs)));
    robot.ports.Correct(command.carrierIDs);
    robot.bTouched = true;
    _bDispatchNeeded = true;
    _changes.emplace_back(CarriersChanged{command.robotID, command.carrierIDs});
    ClearAlarm(MakeAlarm(command.robotID, ALARM_PORT, EAlarmLevel::Light, {}));
    UpdateLoadAlarm(robot);
    Reply(command.replyToken, true, fmt::format("The ports of {} are corrected.", command.robotID));
}

/// Why the step cannot be skipped.
std::optional<std::string> PlanEngine::Impl::GetRejectionReasonOrNull(const SkipStep& command) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        const PlanRecord* finishedOrNull = _plans.FindFinishedOrNull(command.planID);
        return finishedOrNull == nullptr
            ? fmt::format("There is no plan {}.", command.planID)
            : fmt::format("Plan {} is already {}.", command.planID, GetText(finishedOrNull->progress.state));
    }
    const ActivePlan& plan = *planOrNull;
    const std::optional<std::size_t> index = FindStepOrNull(plan.record.plan, command.stepNo);
    if (!index.has_value())
    {
        return fmt::format("Plan {} has no step {}.", command.planID, command.stepNo);
    }
    if (!plan.robot.has_value())
    {
        return fmt::format("No robot has plan {} yet: skip the step when the plan is InProgress.", command.planID);
    }
    const EStepState state = plan.record.progress.steps[*index].state;
    const Robot& robot = _robots[*plan.robot];
    const bool bUnresolved = *index == plan.step && state == EStepState::InProgress && robot.job.IsUnresolved()
        && robot.activity == EActivity::Works;
    if (state == EStepState::Pending || bUnresolved)
    {
        return std::nullopt;
    }
    return fmt::format(
        "Step {} is {}: only a step that is Pending, or whose job is unresolved, can be skipped.",
        command.stepNo,
        GetText(state));
}

/// Section 6.13.
void PlanEngine::Impl::Skip(const SkipStep& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    Reply(command.replyToken, true, fmt::format("Step {} is skipped.", command.stepNo));
    ActivePlan& plan = *_plans.FindActiveOrNull(command.planID);
    Robot& robot = _robots[*plan.robot];
    const std::size_t index = *FindStepOrNull(plan.record.plan, command.stepNo);
    const bool bUnresolved = plan.record.progress.steps[index].state == EStepState::InProgress;
    robot.bTouched = true;
    Note(robot, fmt::format("step {} of plan {} is skipped by an operator", command.stepNo, command.planID));
    ChangeStepAt(plan, index, EStepState::Skipped, "Skipped by the operator.");
    if (bUnresolved)
    {
        SkipUnresolved(robot);
    }
    else if (index == plan.step)
    {
        LeaveStep(robot); // the plan is paused before it
    }
}

/// What became of the job stays unknown, and what is on the robot's ports as it is on record.
void PlanEngine::Impl::SkipUnresolved(Robot& robot)
{
    StopJobTimer(robot);
    ReleaseJob(robot);
    robot.planOrNull->jobTimeLeft.reset();
    LeaveStep(robot);
}

} // namespace ACS::Planning

#include "engine/OperatorCommands.hpp"

#include <acs/core/ControlCharacter.hpp>

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

OperatorCommands::OperatorCommands(
    EngineState& engine,
    LoadWatch& loads,
    const StallWatch& stalls,
    RejectionWatch& rejections,
    PlaceTracker& places,
    TrafficCoordinator& coordinator,
    PlanWork& work,
    JobOutcomes& jobs)
    : _plans(engine.plans),
      _fleet(engine.fleet),
      _alarms(engine.alarms),
      _transaction(engine.transaction),
      _backlog(engine.backlog),
      _loads(loads),
      _stalls(stalls),
      _rejections(rejections),
      _places(places),
      _work(work),
      _jobs(jobs),
      _blocks(engine, coordinator)
{
}

void OperatorCommands::Maintain(const SetMaintenance& command)
{
    Robot* robotOrNull = _fleet.FindOrNull(command.robotID);
    if (robotOrNull == nullptr)
    {
        _transaction.Reply(command.replyToken, false, fmt::format("There is no robot {}.", command.robotID));
        return;
    }
    Robot& robot = *robotOrNull;
    if (std::exchange(robot.view.bInMaintenance, command.bOn) != command.bOn)
    {
        _transaction.Store(MaintenanceChanged{command.robotID, command.bOn});
        robot.changes.MarkStatus();
        _transaction.RequestDispatch();
        _transaction.Note(
            robot,
            command.bOn ? "taken out of service by the operator" : "returned to service by the operator");
        if (!command.bOn && !robot.view.bOnline)
        {
            // During maintenance a robot that is not connected after a start has no alarm.
            _transaction.RaiseAlarm(MakeLinkAlarm(
                robot.GetID(),
                "Robot returned to service while it is disconnected. Check the robot and its network."));
        }
    }
    if (command.bOn && !robot.view.bOnline && !robot.place.bPlaced && !robot.place.possibleNodes.empty())
    {
        _places.ForgetPossibleNodes(robot);
        _transaction.Note(robot, "not on the floor: the nodes of its last position are released");
    }
    const bool bEndsPlan = command.bOn && robot.planOrNull != nullptr;
    _transaction.Reply(
        command.replyToken,
        true,
        fmt::format(
            "{} is {}{}.",
            command.robotID,
            command.bOn ? "in maintenance" : "in service",
            bEndsPlan ? " after plan " + robot.planOrNull->record.plan.planID : ""));
}

void OperatorCommands::ClearByOperator(const ClearAlarms& command)
{
    const std::vector<ErrorReport> cleared = _alarms.ClearIf([&command](const Alarm& alarm) {
        return alarm.robotID == command.robotID && alarm.errorCode == command.errorCode
            && (!command.planID.has_value() || alarm.planID == command.planID)
            && (!command.jobID.has_value() || alarm.jobID == command.jobID);
    });
    if (cleared.empty())
    {
        _transaction.Reply(
            command.replyToken,
            false,
            fmt::format("{} has no alarm {}.", command.robotID, command.errorCode));
        return;
    }
    if (Robot* robotOrNull = _fleet.FindOrNull(command.robotID); robotOrNull != nullptr)
    {
        if (command.errorCode == ALARM_LOADS)
        {
            robotOrNull->ports.ForgetDisputes(); // the record already has the reported loads
        }
        else if (command.errorCode == ALARM_REJECTIONS)
        {
            _rejections.EndRow(*robotOrNull);
        }
    }
    std::size_t lasting = 0;
    for (const ErrorReport& report : cleared)
    {
        _transaction.ReportAlarms({report});
        if (HasCause(report.alarm))
        {
            ++lasting;
            _transaction.RaiseAlarm(report.alarm);
        }
    }
    _transaction.Reply(
        command.replyToken,
        true,
        fmt::format("{} cleared; {} set again because the cause remains.", cleared.size(), lasting));
}

bool OperatorCommands::HasCause(const Alarm& alarm) const
{
    if (alarm.errorCode == ALARM_STORE)
    {
        return _backlog.IsFailing();
    }
    const Robot* robotOrNull = _fleet.FindOrNull(alarm.robotID);
    if (robotOrNull == nullptr)
    {
        return false;
    }
    const Robot& robot = *robotOrNull;
    if (alarm.errorCode == ALARM_LINK_LOST)
    {
        return !robot.view.bOnline;
    }
    if (alarm.errorCode == ALARM_PLACE)
    {
        const bool bOff = robot.drive.has_value() && (robot.drive->bLeftRoute || robot.drive->bOverran);
        return robot.view.bOnline && (!robot.place.bPlaced || bOff);
    }
    if (alarm.errorCode == ALARM_UNRESOLVED)
    {
        return robot.job.IsUnresolved();
    }
    if (alarm.errorCode == ALARM_STALL)
    {
        return _stalls.IsStalled(robot);
    }
    if (alarm.errorCode == ALARM_INCOMPATIBLE)
    {
        return !robot.view.incompatibility.empty();
    }
    return robot.view.state.has_value()
        && std::ranges::count(robot.view.state->errors, alarm.errorCode, &RobotError::errorCode) > 0;
}

void OperatorCommands::CorrectCarriers(const SetCarriers& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    Robot& robot = *_fleet.FindOrNull(command.robotID);
    _transaction.Note(
        robot,
        fmt::format(
            "record of the ports corrected by the operator: it was ({}), it is ({})",
            DescribePorts(robot.ports.GetCarriers()),
            DescribePorts(command.carrierIDs)));
    robot.ports.Correct(command.carrierIDs);
    robot.changes.MarkStatus();
    _transaction.RequestDispatch();
    _transaction.Store(robot.ports.MakeRecord(command.robotID));
    _transaction.ClearAlarm(MakeAlarm(command.robotID, ALARM_PORT, EAlarmLevel::Light, {}));
    _loads.UpdateLoadAlarm(robot);
    _transaction.Reply(command.replyToken, true, fmt::format("The ports of {} are corrected.", command.robotID));
}

/// Jobs can be resolved if they are unresolved, if their plan has ended, or if their robot is disconnected.
std::optional<std::string> OperatorCommands::GetRejectionReasonOrNull(const ResolveJob& command) const
{
    const std::optional<std::size_t> worker = FindWorkerOrNull(command);
    if (!worker.has_value())
    {
        return fmt::format("No robot has job {} of plan {}.", command.jobID, command.planID);
    }
    const Robot& robot = _fleet[*worker];
    const bool bOver = robot.job.IsOverdue();
    if (bOver && command.resolution == EJobResolution::Again)
    {
        return fmt::format("Plan {} has ended: answer done or failed.", command.planID);
    }
    if (robot.job.IsUnresolved() || bOver)
    {
        return std::nullopt;
    }
    if (robot.view.bOnline)
    {
        return fmt::format("{} is connected and will report the outcome of the job.", robot.GetID());
    }
    return command.resolution == EJobResolution::Again ? std::optional(
               fmt::format("{} is disconnected and cannot repeat the job: answer done or failed.", robot.GetID()))
                                                       : std::nullopt;
}

std::optional<std::string> OperatorCommands::GetRejectionReasonOrNull(const SetCarriers& command) const
{
    const Robot* robotOrNull = _fleet.FindOrNull(command.robotID);
    if (robotOrNull == nullptr)
    {
        return fmt::format("There is no robot {}.", command.robotID);
    }
    const Robot& robot = *robotOrNull;
    if (command.carrierIDs.size() != robot.ports.GetCarriers().size())
    {
        return fmt::format(
            "{} has {} carrier ports, but the command gives carriers for {}. Give one entry per port; null (acsctl: -) is no carrier.",
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
            return fmt::format("Invalid carrierId: expected 1 to {} bytes.", MAXIMUM_ID_LENGTH);
        }
        if (Core::HasControlCharacter(*carrier))
        {
            return std::string("Invalid carrierId: control characters are not allowed.");
        }
        if (std::ranges::count(command.carrierIDs, carrier) > 1)
        {
            return fmt::format("Carrier {} is given for two ports.", *carrier);
        }
        for (const Robot& other : _fleet)
        {
            if (&other != &robot && other.ports.FindCarrierOrNull(*carrier).has_value())
            {
                return fmt::format(
                    "Carrier {} is on {}. Correct the ports of that robot first.",
                    *carrier,
                    other.GetID());
            }
        }
    }
    return std::nullopt;
}

std::optional<std::string> OperatorCommands::GetRejectionReasonOrNull(const SkipStep& command) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        return DescribeInactive(command.planID);
    }
    const ActivePlan& plan = *planOrNull;
    const std::optional<std::size_t> index = FindStepOrNull(plan.record.plan, command.stepNo);
    if (!index.has_value())
    {
        return fmt::format("Plan {} has no step {}.", command.planID, command.stepNo);
    }
    if (!plan.robot.has_value() || IsOffered(plan))
    {
        return fmt::format("Plan {} has no robot yet. Skip the step once the plan is InProgress.", command.planID);
    }
    const EStepState state = plan.record.progress.steps[*index].state;
    const Robot& robot = _fleet[*plan.robot];
    const bool bUnresolved = *index == plan.step && state == EStepState::InProgress && robot.job.IsUnresolved()
        && robot.activity == EActivity::Works;
    if (state == EStepState::Pending || bUnresolved)
    {
        return std::nullopt;
    }
    return fmt::format(
        "Step {} is {}. Only a Pending step or a step with an unresolved job can be skipped.",
        command.stepNo,
        GetText(state));
}

std::optional<std::string> OperatorCommands::GetRejectionReasonOrNull(const SetPlanPriority& command) const
{
    const ActivePlan* planOrNull = _plans.FindActiveOrNull(command.planID);
    if (planOrNull == nullptr)
    {
        return DescribeInactive(command.planID);
    }
    const EPlanState state = planOrNull->record.progress.state;
    return state == EPlanState::Pending
        ? std::nullopt
        : std::optional(fmt::format(
            "Plan {} is {}. Only the priority of a plan that waits in the queue can be changed.",
            command.planID,
            GetText(state)));
}

std::string OperatorCommands::DescribeInactive(const std::string& planID) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(planID);
    return recordOrNull == nullptr
        ? fmt::format("There is no plan {}.", planID)
        : fmt::format("Plan {} is already {}.", planID, GetText(recordOrNull->progress.state));
}

void OperatorCommands::ChangePriority(const SetPlanPriority& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    _plans.SetPriority(*_plans.FindActiveOrNull(command.planID), command.priority);
    _transaction.RequestDispatch();
    _transaction.Reply(
        command.replyToken,
        true,
        fmt::format("Plan {} has the priority {}.", command.planID, command.priority));
}

BlockControl& OperatorCommands::GetBlocks() noexcept
{
    return _blocks;
}

const BlockControl& OperatorCommands::GetBlocks() const noexcept
{
    return _blocks;
}

void OperatorCommands::Skip(const SkipStep& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    _transaction.Reply(command.replyToken, true, fmt::format("Step {} is skipped.", command.stepNo));
    ActivePlan& plan = *_plans.FindActiveOrNull(command.planID);
    Robot& robot = _fleet[*plan.robot];
    const std::size_t index = *FindStepOrNull(plan.record.plan, command.stepNo);
    const bool bUnresolved = plan.record.progress.steps[index].state == EStepState::InProgress;
    robot.changes.MarkStatus();
    _transaction.Note(robot, fmt::format("step {} of plan {} skipped by the operator", command.stepNo, command.planID));
    _transaction.ChangeStepAt(plan, index, EStepState::Skipped, "Skipped by the operator.");
    if (bUnresolved)
    {
        SkipUnresolved(robot);
    }
    else if (index == plan.step)
    {
        _work.LeaveStep(robot); // the plan is paused before this step
    }
}

void OperatorCommands::SkipUnresolved(Robot& robot)
{
    _work.StopJobTimer(robot);
    _work.AbandonJob(robot);
    _work.ReleaseJob(robot);
    robot.planOrNull->jobClock.timeLeft.reset();
    _work.LeaveStep(robot);
}

std::optional<std::size_t> OperatorCommands::FindWorkerOrNull(const ResolveJob& command) const
{
    const auto robot = std::ranges::find_if(_fleet, [&command](const Robot& candidate) {
        const StartJob* jobOrNull = candidate.job.GetOrNull();
        return jobOrNull != nullptr && jobOrNull->planID == command.planID && jobOrNull->jobID == command.jobID;
    });
    return robot == _fleet.end() ? std::nullopt : std::optional(robot->index);
}

void OperatorCommands::Resolve(const ResolveJob& command)
{
    if (std::optional<std::string> reason = GetRejectionReasonOrNull(command))
    {
        _transaction.Reply(command.replyToken, false, std::move(*reason));
        return;
    }
    Robot& robot = _fleet[*FindWorkerOrNull(command)];
    _transaction.Reply(command.replyToken, true, "Received.");
    robot.changes.MarkStatus();
    ApplyAnswer(robot, command.resolution);
}

void OperatorCommands::ApplyAnswer(Robot& robot, EJobResolution answer)
{
    robot.job.Resolve();
    if (answer == EJobResolution::Failed)
    {
        _work.AbandonJob(robot);
    }
    const std::string jobID = robot.job.GetOrNull()->jobID;
    if (!_jobs.TryEndOverdueJob(robot, jobID, answer == EJobResolution::Done))
    {
        ApplyToPlan(robot, jobID, answer);
    }
}

void OperatorCommands::ApplyToPlan(Robot& robot, const std::string& jobID, EJobResolution answer)
{
    switch (answer)
    {
        case EJobResolution::Done:
            CatchUp(robot);
            _jobs.OnJobStarted(robot, JobStarted{jobID});
            _work.EndJob(robot, "Reported as done by the operator.");
            break;
        case EJobResolution::Again:
            robot.work.TryResolve(); // no later job was done either
            _work.RepeatJob(robot, {});
            break;
        case EJobResolution::Failed:
        default:
            _jobs.OnJobFailed(robot, JobFailed{jobID, "Reported as not done by the operator."});
            break;
    }
}

void OperatorCommands::CatchUp(Robot& robot)
{
    ActivePlan& plan = *robot.planOrNull;
    _work.MarkArrived(robot);
    plan.bJobBegun = true;
    if (HasJob(plan) && GetJobState(plan) == EJobState::Pending)
    {
        _transaction.ChangeJob(plan, EJobState::Instructed, {});
    }
}

} // namespace ACS::Planning

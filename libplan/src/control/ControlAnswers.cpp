#include "control/ControlAnswers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ACS::Planning
{

ControlAnswers::ControlAnswers(EngineState& engine)
    : _options(engine.options),
      _plans(engine.plans),
      _fleet(engine.fleet),
      _hold(engine.hold),
      _transaction(engine.transaction)
{
}

std::string ControlAnswers::MakeRequestID(const ControlPlan& command)
{
    return fmt::format("{} {}", GetText(command.control), command.transactionID);
}

bool ControlAnswers::IsRepetition(const ControlPlan& command) const
{
    const PlanRecord* recordOrNull = _plans.FindRecordOrNull(command.planID);
    return recordOrNull != nullptr && !command.transactionID.empty()
        && std::ranges::count(recordOrNull->progress.requestIDs, MakeRequestID(command)) > 0;
}

void ControlAnswers::Remember(PlanProgress& progress, const ControlPlan& command)
{
    constexpr std::size_t MOST_REMEMBERED = 64; // an MCS without an Ack may send one again after many others
    if (command.transactionID.empty())
    {
        return;
    }
    if (progress.requestIDs.size() == MOST_REMEMBERED)
    {
        progress.requestIDs.erase(progress.requestIDs.begin());
    }
    progress.requestIDs.push_back(MakeRequestID(command));
    _plans.MarkProgressed(command.planID);
}

void ControlAnswers::Withdraw(ActivePlan& plan, const ControlPlan& command)
{
    std::erase(plan.record.progress.requestIDs, MakeRequestID(command));
    plan.record.progress.control.reset();
    plan.record.progress.controlCount = 0;
    _plans.MarkProgressed(plan.record.plan.planID);
}

void ControlAnswers::Ask(ActivePlan& plan, EPlanControl control, EControlOrigin origin)
{
    _plans.MarkProgressed(plan.record.plan.planID);
    plan.record.progress.control = control;
    plan.record.progress.controlCount = origin == EControlOrigin::MCS ? 1 : 0;
    plan.record.progress.controlOrigin = origin;
}

std::string ControlAnswers::DescribeOrigin(const ActivePlan& plan, EPlanControl control)
{
    return plan.record.progress.controlOrigin == EControlOrigin::Operator ? "the operator"
                                                                          : fmt::format("{}Plan", GetText(control));
}

void ControlAnswers::Answer(ActivePlan& plan, bool bSucceeded, const std::string& message)
{
    const std::optional<EPlanControl> control = std::exchange(plan.record.progress.control, std::nullopt);
    if (!control.has_value())
    {
        return;
    }
    _plans.MarkProgressed(plan.record.plan.planID);
    if (plan.robot.has_value())
    {
        Robot& robot = _fleet[*plan.robot];
        robot.control.bStandstillAwaited = false;
        StopConfirmingControl(robot);
        if (!bSucceeded && plan.record.progress.controlOrigin == EControlOrigin::Operator)
        {
            _transaction.Note(
                robot,
                fmt::format(
                    "{}Plan of the operator failed for plan {}: {}",
                    GetText(*control),
                    plan.record.plan.planID,
                    message));
        }
    }
    for (std::size_t count = std::exchange(plan.record.progress.controlCount, 0); count > 0; --count)
    {
        ReportControlResult(*control, plan.record.plan.planID, bSucceeded, message);
    }
}

void ControlAnswers::ReportControlResult(
    EPlanControl control,
    const std::string& planID,
    bool bSucceeded,
    std::string message)
{
    _transaction.AddReport(ControlResultReport{control, planID, bSucceeded, std::move(message)});
}

void ControlAnswers::StartConfirming(Robot& robot, Core::Duration limit)
{
    robot.control.bConfirming = true;
    _transaction.StartTimer(EEngineTimer::ControlConfirm, robot.GetID(), limit);
}

void ControlAnswers::StopConfirming(Robot& robot)
{
    if (std::exchange(robot.control.bConfirming, false))
    {
        _transaction.CancelTimer(EEngineTimer::ControlConfirm, robot.GetID());
    }
}

void ControlAnswers::StopConfirmingControl(Robot& robot)
{
    StopConfirming(robot);
    if (robot.drive.has_value() && robot.drive->reroute.has_value())
    {
        StartConfirming(robot, _options.controls.cancelTimeout);
    }
}

void ControlAnswers::LeavePause(ActivePlan& plan, std::string message)
{
    _transaction.ChangePlan(
        plan,
        plan.robot.has_value() ? EPlanState::InProgress : EPlanState::Pending,
        std::move(message));
}

void ControlAnswers::ReleasePause(Robot& robot)
{
    if (robot.control.pause.TryResume() && !_hold.IsActive())
    {
        _transaction.Command(robot, Planning::Resume{});
    }
}

std::string ControlAnswers::DescribeInactive(const std::string& planID) const
{
    const PlanRecord* finishedOrNull = std::as_const(_plans).FindFinishedOrNull(planID);
    return finishedOrNull == nullptr ? fmt::format("There is no plan {}.", planID)
                                     : fmt::format("The plan is already {}.", GetText(finishedOrNull->progress.state));
}

void ControlAnswers::RefuseControl(const ControlPlan& command)
{
    PlanRecord* finishedOrNull = _plans.FindFinishedOrNull(command.planID);
    const bool bKnown = finishedOrNull != nullptr;
    const std::string reason = DescribeInactive(command.planID);
    _transaction.Reply(command.replyToken, bKnown, bKnown ? "Received." : reason);
    if (bKnown)
    {
        Remember(finishedOrNull->progress, command);
    }
    if (bKnown || _options.controls.bResultAfterRefusal)
    {
        ReportControlResult(command.control, command.planID, false, reason);
    }
}

} // namespace ACS::Planning

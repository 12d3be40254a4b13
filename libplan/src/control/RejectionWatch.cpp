#include "control/RejectionWatch.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

RejectionWatch::RejectionWatch(EngineState& engine)
    : _options(engine.options),
      _transaction(engine.transaction)
{
}

void RejectionWatch::OnRejected(Robot& robot, const std::string& reason)
{
    _transaction.RequestDispatch();
    if (!robot.view.bOnline || !robot.view.state.has_value() || !robot.view.state->bAutomatic)
    {
        return;
    }
    RejectionTracker& rejections = robot.view.rejections;
    rejections.Add(reason, _options.maximumRejections);
    robot.changes.MarkStatus();
    if (rejections.GetState() == ERejection::Delayed)
    {
        _transaction.StartTimer(EEngineTimer::RejectionRetry, robot.GetID(), _options.rejectionRetry);
        return;
    }
    Alarm alarm = MakeRejectionAlarm(robot);
    alarm.message = fmt::format(
        "Robot unavailable: it rejected {} commands in a row, the last one because {}. Check the robot. It is sent its command "
        "again after a reconnect, a change of its mode, errors or factsheet, or when this alarm is cleared.",
        rejections.GetCount(),
        reason);
    _transaction.RaiseAlarm(std::move(alarm));
}

void RejectionWatch::OnRetryDue(Robot& robot)
{
    if (robot.view.rejections.GetState() == ERejection::Delayed && robot.view.rejections.TryRetry())
    {
        robot.changes.MarkStatus();
        _transaction.RequestDispatch();
    }
}

void RejectionWatch::OnRobotChanged(Robot& robot)
{
    if (robot.view.rejections.GetState() == ERejection::Exhausted && robot.view.rejections.TryRetry())
    {
        robot.changes.MarkStatus();
        _transaction.RequestDispatch();
    }
}

void RejectionWatch::EndRow(Robot& robot)
{
    if (robot.view.rejections.TryReset())
    {
        _transaction.CancelTimer(EEngineTimer::RejectionRetry, robot.GetID());
        _transaction.ClearAlarm(MakeRejectionAlarm(robot));
        robot.changes.MarkStatus();
        _transaction.RequestDispatch();
    }
}

void RejectionWatch::OnCompatibility(Robot& robot, const CompatibilityChanged& event)
{
    robot.view.incompatibility = event.incompatibility;
    robot.changes.MarkStatus();
    Alarm alarm = MakeAlarm(robot.GetID(), ALARM_INCOMPATIBLE, EAlarmLevel::Heavy, {});
    if (event.incompatibility.empty())
    {
        _transaction.ClearAlarm(alarm);
    }
    else
    {
        alarm.message = "Robot incompatible: " + event.incompatibility;
        _transaction.RaiseAlarm(std::move(alarm));
    }
    _transaction.RequestDispatch();
}

Alarm RejectionWatch::MakeRejectionAlarm(const Robot& robot)
{
    return MakeAlarm(robot.GetID(), ALARM_REJECTIONS, EAlarmLevel::Heavy, {});
}

} // namespace ACS::Planning

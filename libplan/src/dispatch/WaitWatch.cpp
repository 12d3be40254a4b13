#include "dispatch/WaitWatch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace ACS::Planning
{

WaitWatch::WaitWatch(
    EngineState& engine,
    const TscControl& tsc,
    const StallWatch& stalls,
    const WaitingRobots& waiting,
    const TrafficCoordinator& coordinator,
    const Dispatcher& dispatcher)
    : _options(engine.options),
      _hold(engine.hold),
      _fleet(engine.fleet),
      _alarms(engine.alarms),
      _transaction(engine.transaction),
      _waiting(waiting),
      _reasons(engine, tsc, stalls, waiting, coordinator, dispatcher),
      _waits(engine.options.robots.size())
{
}

const WaitReasons& WaitWatch::GetReasons() const noexcept
{
    return _reasons;
}

void WaitWatch::UpdateWaits()
{
    if (_fleet.GetChanged().work.empty())
    {
        return;
    }
    for (const std::size_t robot : _fleet.GetChanged().work)
    {
        UpdateWait(_fleet[robot]);
    }
    for (const Robot& robot : _fleet)
    {
        if (_waits[robot.index] == EWait::Deferred && DescribeOrNull(robot).has_value())
        {
            StartTimer(robot);
        }
    }
}

void WaitWatch::UpdateWait(const Robot& robot)
{
    EWait& wait = _waits[robot.index];
    if (IsWaiting(robot) == (wait != EWait::None))
    {
        return;
    }
    if (wait == EWait::None)
    {
        StartTimer(robot);
        return;
    }
    if (wait == EWait::Reported)
    {
        _transaction.ReportAlarms(_alarms.ClearIf(
            [&robot](const Alarm& alarm) { return alarm.robotID == robot.GetID() && alarm.errorCode == ALARM_WAIT; }));
    }
    _transaction.CancelTimer(EEngineTimer::DriveWait, robot.GetID());
    wait = EWait::None;
}

void WaitWatch::OnWaitDue(const Robot& robot)
{
    EWait& wait = _waits[robot.index];
    if (wait != EWait::Timed)
    {
        return;
    }
    const std::optional<WaitReason> reason = DescribeOrNull(robot);
    if (!reason.has_value())
    {
        wait = EWait::Deferred;
        return;
    }
    wait = EWait::Reported;
    Alarm alarm = MakeAlarm(
        robot.GetID(),
        ALARM_WAIT,
        EAlarmLevel::Light,
        fmt::format(
            "No progress for {} s: {}",
            std::chrono::duration_cast<std::chrono::seconds>(_options.waitTimeout).count(),
            reason->message));
    const Plan& plan = robot.planOrNull->record.plan;
    alarm.planID = plan.planID;
    alarm.stepNo = plan.steps[robot.planOrNull->step].stepNo;
    _transaction.RaiseAlarm(std::move(alarm));
}

bool WaitWatch::IsWaiting(const Robot& robot) const
{
    return _options.waitTimeout.count() > 0 && robot.planOrNull != nullptr
        && robot.planOrNull->record.progress.state != EPlanState::Paused && _waiting.IsWaiting(robot);
}

std::optional<WaitReason> WaitWatch::DescribeOrNull(const Robot& robot) const
{
    const bool bStuck = IsWaiting(robot) && !_hold.IsActive() && !_waiting.HasMovingBlocker(robot);
    return bStuck ? _reasons.DescribeBegunOrNull(*robot.planOrNull) : std::nullopt;
}

void WaitWatch::StartTimer(const Robot& robot)
{
    _waits[robot.index] = EWait::Timed;
    _transaction.StartTimer(EEngineTimer::DriveWait, robot.GetID(), _options.waitTimeout);
}

} // namespace ACS::Planning

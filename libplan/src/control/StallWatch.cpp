#include "control/StallWatch.hpp"

#include "site/DriveTime.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <utility>

namespace ACS::Planning
{

StallWatch::StallWatch(EngineState& engine)
    : _options(engine.options),
      _fleet(engine.fleet),
      _alarms(engine.alarms),
      _transaction(engine.transaction),
      _monitors(engine.options.robots.size())
{
}

void StallWatch::UpdateStalls()
{
    std::vector<std::size_t>& marked = _fleet.GetChanged().work;
    const std::vector<std::size_t> changed = TakeInOrder(marked);
    marked = changed; // the marks stay: StoreGate removes them
    for (const std::size_t robot : changed)
    {
        UpdateStall(_fleet[robot]);
    }
}

void StallWatch::UpdateStall(Robot& robot)
{
    if (!robot.changes.IsWorkMarked())
    {
        return;
    }
    std::optional<DriveProgress> progress;
    if (robot.drive.has_value() && robot.view.bOnline)
    {
        progress = DriveProgress{robot.drive->driveID, robot.drive->bTaken, robot.drive->passed};
    }
    else if (IsJobUnconfirmed(robot))
    {
        progress = DriveProgress{robot.job.GetOrNull()->commandID};
    }
    const std::optional<std::size_t> releasedCount = IsProgressExpected(robot)
        ? std::optional(robot.drive.has_value() ? robot.drive->releasedCount : 0)
        : std::nullopt;
    const StallMonitor::Update update =
        _monitors[robot.index].OnProgress(std::move(progress), releasedCount, _transaction.GetNow().steady);
    if (update.bStallEnded)
    {
        // The plan that the alarm names may have ended.
        _transaction.ReportAlarms(_alarms.ClearIf(
            [&robot](const Alarm& alarm) { return alarm.robotID == robot.GetID() && alarm.errorCode == ALARM_STALL; }));
    }
    if (update.timer == EStallTimer::Start)
    {
        _transaction.StartTimer(
            EEngineTimer::DriveStall,
            robot.GetID(),
            StallMonitor::GetLimit(_options.stallTimeout, GetEdgeSeconds(robot)));
    }
    else if (update.timer == EStallTimer::Cancel)
    {
        _transaction.CancelTimer(EEngineTimer::DriveStall, robot.GetID());
    }
}

void StallWatch::OnDriveStall(Robot& robot)
{
    if (!_monitors[robot.index].TryStall())
    {
        return;
    }
    robot.changes.MarkStatus();
    Alarm alarm = MakeAlarm(
        robot.GetID(),
        ALARM_STALL,
        EAlarmLevel::Light,
        fmt::format("Robot stalled: {}. Check the robot.", DescribeStall(robot)));
    if (robot.planOrNull != nullptr)
    {
        const Plan& plan = robot.planOrNull->record.plan;
        alarm.planID = plan.planID;
        alarm.stepNo = plan.steps[robot.planOrNull->step].stepNo;
    }
    _transaction.RaiseAlarm(std::move(alarm));
}

bool StallWatch::IsStalled(const Robot& robot) const
{
    return _monitors[robot.index].IsStalled() && (robot.drive.has_value() || robot.job.GetOrNull() != nullptr);
}

bool StallWatch::IsProgressExpected(const Robot& robot) const
{
    if (_options.stallTimeout.count() == 0 || !robot.view.bOnline || robot.control.pause.IsPaused())
    {
        return false;
    }
    return robot.drive.has_value() ? !robot.drive->bTaken || !robot.drive->IsAtBaseEnd() : IsJobUnconfirmed(robot);
}

bool StallWatch::IsJobUnconfirmed(const Robot& robot)
{
    return !robot.drive.has_value() && robot.activity == EActivity::Works && robot.job.GetOrNull() != nullptr
        && !robot.job.HasBegun() && !robot.job.IsUnresolved() && !robot.job.IsRecovering() && !robot.job.IsOverdue()
        && robot.IsUsable();
}

double StallWatch::GetEdgeSeconds(const Robot& robot)
{
    if (!robot.drive.has_value() || robot.drive->passed >= robot.drive->route.edges.size())
    {
        return 0;
    }
    const RouteEdge& edge = robot.drive->route.edges[robot.drive->passed];
    return GetDriveSeconds(edge.length, edge.maxSpeed);
}

std::string StallWatch::DescribeStall(const Robot& robot) const
{
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(
                             _monitors[robot.index].GetTimeWithoutProgress(_transaction.GetNow().steady))
                             .count();
    if (!robot.drive.has_value())
    {
        return fmt::format("job {} not confirmed for {} s", robot.job.GetOrNull()->jobID, seconds);
    }
    const ActiveDrive& drive = *robot.drive;
    const EUnavailability unavailability = robot.GetUnavailability();
    return fmt::format(
        "{} {} {} for {} s{}",
        drive.bTaken ? "node" : "drive to node",
        drive.GetNextNodeID(),
        drive.bTaken ? "not reached" : "not confirmed",
        seconds,
        unavailability == EUnavailability::None ? std::string() : fmt::format(" ({})", robot.Describe(unavailability)));
}

} // namespace ACS::Planning

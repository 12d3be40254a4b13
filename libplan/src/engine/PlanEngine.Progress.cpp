#include "engine/PlanEngine.Impl.hpp"
#include "traffic/FloorGraph.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// Whether the robot must pass another node soon: it is connected, may drive and has a base ahead.
bool PlanEngine::Impl::IsProgressExpected(const Robot& robot) const
{
    return _options.stallTimeout.count() > 0 && robot.bOnline && robot.drive.has_value() && !robot.pause.IsPaused()
        && (!robot.drive->bTaken || !robot.drive->IsAtBaseEnd());
}

/// At the end of every call.
void PlanEngine::Impl::UpdateStall(Robot& robot)
{
    if (!robot.bWorkTouched)
    {
        return;
    }
    std::optional<DriveProgress> progress;
    if (robot.drive.has_value() && robot.bOnline)
    {
        progress = DriveProgress{robot.drive->driveID, robot.drive->bTaken, robot.drive->passed};
    }
    const std::optional<std::size_t> releasedCount =
        IsProgressExpected(robot) ? std::optional(robot.drive->releasedCount) : std::nullopt;
    const StallMonitor::Update update = robot.stall.OnProgress(std::move(progress), releasedCount, _now.steady);
    if (update.bStallEnded)
    {
        // Its plan may be over meanwhile.
        ReportAlarms(_alarms.ClearIf([this, &robot](const Alarm& alarm) {
            return alarm.robotID == GetRobotID(robot) && alarm.errorCode == ALARM_STALL;
        }));
    }
    if (update.timer == EStallTimer::Start)
    {
        const std::vector<RouteEdge>& edges = robot.drive->route.edges;
        const std::size_t edge = robot.drive->passed;
        const double seconds = edge < edges.size() ? GetDriveSeconds(edges[edge].length, edges[edge].maxSpeed) : 0.0;
        StartTimer(EEngineTimer::DriveStall, GetRobotID(robot), StallMonitor::GetLimit(_options.stallTimeout, seconds));
    }
    else if (update.timer == EStallTimer::Cancel)
    {
        CancelTimer(EEngineTimer::DriveStall, GetRobotID(robot));
    }
}

void PlanEngine::Impl::OnDriveStall(Robot& robot)
{
    if (!robot.stall.TryStall())
    {
        return;
    }
    robot.bTouched = true;
    Alarm alarm = MakeAlarm(
        GetRobotID(robot),
        ALARM_STALL,
        EAlarmLevel::Light,
        fmt::format("It does not get on: {}.", DescribeStall(robot)));
    if (robot.planOrNull != nullptr)
    {
        const Plan& plan = robot.planOrNull->record.plan;
        alarm.planID = plan.planID;
        alarm.stepNo = plan.steps[robot.planOrNull->step].stepNo;
    }
    RaiseAlarm(std::move(alarm));
}

std::string PlanEngine::Impl::DescribeStall(const Robot& robot) const
{
    const ActiveDrive& drive = *robot.drive;
    const EUnavailability unavailability = GetUnavailability(robot);
    return fmt::format(
        "{} node {}{} since {} s{}; look at the robot",
        drive.bTaken ? "it has not come to" : "it has not shown that it took its drive to",
        drive.GetNextNodeID(),
        robot.planOrNull == nullptr ? std::string() : " for plan " + robot.planOrNull->record.plan.planID,
        std::chrono::duration_cast<std::chrono::seconds>(robot.stall.GetTimeWithoutProgress(_now.steady)).count(),
        unavailability == EUnavailability::None ? std::string()
                                                : fmt::format(" ({})", Describe(robot, unavailability)));
}

} // namespace ACS::Planning

#include "engine/PlanEngine.Impl.hpp"
#include "traffic/FloorGraph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Planning
{

/// Whether it has come to the last node that it may go to, short of its aim.
bool PlanEngine::Impl::IsAtBaseEnd(const ActiveDrive& drive)
{
    return drive.passed + 1 >= drive.releasedCount && drive.releasedCount < drive.nodes.size();
}

/// Whether another node is to be expected of it, and nobody but itself keeps it from that.
bool PlanEngine::Impl::IsToGetOn(const Robot& robot) const
{
    return _options.stallTimeout.count() > 0 && robot.bOnline && robot.drive.has_value() && !robot.bPauseWanted
        && (!robot.drive->bTaken || !IsAtBaseEnd(*robot.drive));
}

/// A long edge at low speed takes its time.
Core::Duration PlanEngine::Impl::GetStallLimit(const ActiveDrive& drive) const
{
    constexpr double PATIENCE = 3;
    constexpr std::chrono::duration<double> LONGEST = std::chrono::hours(24);
    Core::Duration limit = _options.stallTimeout;
    if (drive.passed < drive.route.edges.size())
    {
        const RouteEdge& edge = drive.route.edges[drive.passed];
        const std::chrono::duration<double> patient(PATIENCE * GetDriveSeconds(edge.length, edge.maxSpeed));
        const Core::Duration edgeLimit = std::chrono::ceil<std::chrono::milliseconds>(std::min(patient, LONGEST));
        limit = std::max(limit, edgeLimit);
    }
    return limit;
}

/// At the end of every call: the watch begins anew with each node, each extension, and when it may go on again.
void PlanEngine::Impl::FollowDrive(Robot& robot)
{
    if (!robot.bWorkTouched)
    {
        return;
    }
    std::optional<Milestone> milestone;
    if (robot.drive.has_value() && robot.bOnline)
    {
        milestone = Milestone{robot.drive->driveID, robot.drive->bTaken, robot.drive->passed};
    }
    const bool bGotOn = milestone != robot.milestone;
    robot.milestone = std::move(milestone);
    if (bGotOn && std::exchange(robot.bStalled, false))
    {
        // Its plan may be over meanwhile.
        ReportAlarms(_alarms.ClearIf([this, &robot](const Alarm& alarm) {
            return alarm.robotID == GetRobotID(robot) && alarm.errorCode == ALARM_STALL;
        }));
    }
    const std::optional<std::size_t> base = IsToGetOn(robot) ? std::optional(robot.drive->releasedCount) : std::nullopt;
    const bool bWatched = robot.watchedBase.has_value();
    if (!bGotOn && base == robot.watchedBase)
    {
        return;
    }
    robot.watchedBase = base;
    if (base.has_value())
    {
        robot.progressAt = _now.steady;
        StartTimer(EEngineTimer::DriveStall, GetRobotID(robot), GetStallLimit(*robot.drive));
    }
    else if (bWatched)
    {
        CancelTimer(EEngineTimer::DriveStall, GetRobotID(robot));
    }
}

void PlanEngine::Impl::OnDriveStall(Robot& robot)
{
    if (!robot.watchedBase.has_value())
    {
        return;
    }
    robot.bStalled = true;
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
    const std::vector<RouteNode>& nodes = drive.route.nodes;
    const EHindrance hindrance = GetHindrance(robot);
    return fmt::format(
        "{} node {}{} since {} s{}; look at the robot",
        drive.bTaken ? "it has not come to" : "it has not shown that it took its drive to",
        nodes[std::min(drive.passed + 1, nodes.size() - 1)].nodeID,
        robot.planOrNull == nullptr ? std::string() : " for plan " + robot.planOrNull->record.plan.planID,
        std::chrono::duration_cast<std::chrono::seconds>(_now.steady - robot.progressAt).count(),
        hindrance == EHindrance::None ? std::string() : fmt::format(" ({})", Describe(robot, hindrance)));
}

} // namespace ACS::Planning

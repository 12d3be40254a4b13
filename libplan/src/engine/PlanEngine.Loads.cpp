#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

/// The alarm is set or updated once in this time at most. It is cleared at once.
constexpr std::chrono::seconds LOAD_ALARM_INTERVAL{10};

} // namespace

void PlanEngine::Impl::CompareLoads(Robot& robot)
{
    if (!robot.state->loads.has_value() || robot.work.IsDoubtful())
    {
        return;
    }
    const StartJob* jobOrNull = robot.job.GetOrNull();
    const std::vector<PortUse> openUses =
        jobOrNull != nullptr ? ListPortUses(robot, *jobOrNull) : std::vector<PortUse>();
    const PortLedger::Comparison comparison = robot.ports.Compare(*robot.state->loads, openUses);
    if (comparison.bRecordChanged)
    {
        _changes.emplace_back(CarriersChanged{GetRobotID(robot), robot.ports.GetCarriers()});
        _bDispatchNeeded = true;
    }
    if (comparison.bDisputed)
    {
        UpdateLoadAlarm(robot);
    }
}

/// Set until each port shows again what was expected there, a job has moved its carrier, or an operator has checked it. A robot
/// whose loads change with each state must not flood the MCS: the first difference is reported at once, then the latest one
/// when the timer LoadAlarm has expired.
void PlanEngine::Impl::UpdateLoadAlarm(Robot& robot)
{
    Alarm alarm = MakeAlarm(
        GetRobotID(robot),
        ALARM_LOADS,
        EAlarmLevel::Light,
        fmt::format(
            "Reported loads differ from the record: {}. The record follows the robot, but a carrier shown at two ports "
            "changes no id. Check the ports, then correct the record or clear the alarm.",
            robot.ports.DescribeDisputes()));
    if (!robot.ports.IsDisputed())
    {
        ClearAlarm(alarm);
        return;
    }
    if (!_alarms.Contains(alarm) && robot.ports.TryBeginReportInterval())
    {
        StartTimer(EEngineTimer::LoadAlarm, GetRobotID(robot), LOAD_ALARM_INTERVAL);
        ReportAlarms(_alarms.Update(std::move(alarm)));
    }
}

void PlanEngine::Impl::OnLoadAlarmTimer(Robot& robot)
{
    robot.ports.EndReportInterval();
    if (robot.ports.IsDisputed())
    {
        UpdateLoadAlarm(robot);
    }
}

} // namespace ACS::Planning

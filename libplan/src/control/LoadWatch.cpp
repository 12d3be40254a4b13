#include "control/LoadWatch.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Minimum time between two updates of the alarm. Clearing is not delayed.
constexpr std::chrono::seconds LOAD_ALARM_INTERVAL{10};

} // namespace

LoadWatch::LoadWatch(EngineState& engine)
    : _options(engine.options),
      _alarms(engine.alarms),
      _transaction(engine.transaction)
{
}

void LoadWatch::CompareLoads(Robot& robot)
{
    if (!robot.view.state->loads.has_value() || robot.work.IsUnresolved())
    {
        return;
    }
    const StartJob* jobOrNull = robot.job.GetOrNull();
    const std::vector<PortUse> openUses =
        jobOrNull != nullptr ? ListPortUses(robot, *jobOrNull) : std::vector<PortUse>();
    const PortLedger::Comparison comparison = robot.ports.Compare(*robot.view.state->loads, openUses);
    if (comparison.bRecordChanged)
    {
        _transaction.Store(robot.ports.MakeRecord(robot.GetID()));
        _transaction.RequestDispatch();
    }
    if (comparison.bDisputed)
    {
        UpdateLoadAlarm(robot);
    }
}

void LoadWatch::UpdateLoadAlarm(Robot& robot)
{
    Alarm alarm = MakeAlarm(
        robot.GetID(),
        ALARM_LOADS,
        EAlarmLevel::Light,
        fmt::format(
            "Reported loads differ from the record: {}. The record now has the reported loads, except carriers reported at "
            "two ports. Check the ports, then correct the record or clear the alarm.",
            robot.ports.DescribeDisputes()));
    if (!robot.ports.IsDisputed())
    {
        _transaction.ClearAlarm(alarm);
        return;
    }
    if (_alarms.Contains(alarm))
    {
        _transaction.RaiseAlarm(std::move(alarm)); // changes nothing but that a delayed clear is dropped
        return;
    }
    if (robot.ports.TryBeginReportInterval())
    {
        _transaction.StartTimer(EEngineTimer::LoadAlarm, robot.GetID(), LOAD_ALARM_INTERVAL);
        _transaction.ReportAlarms(_alarms.Update(std::move(alarm), _transaction.GetNow().steady));
    }
}

void LoadWatch::OnLoadAlarmTimer(Robot& robot)
{
    robot.ports.EndReportInterval();
    if (robot.ports.IsDisputed())
    {
        UpdateLoadAlarm(robot);
    }
}

void LoadWatch::MoveCarrier(Robot& robot, const StartJob& job)
{
    const std::vector<PortUse> uses = ListPortUses(robot, job);
    if (uses.empty())
    {
        return;
    }
    const std::string contradiction = robot.ports.Move(uses, job.carrierID);
    Alarm alarm = MakeAlarm(robot.GetID(), ALARM_PORT, EAlarmLevel::Light, contradiction);
    if (contradiction.empty())
    {
        _transaction.ClearAlarm(alarm);
    }
    else
    {
        _transaction.RaiseAlarm(std::move(alarm));
    }
    UpdateLoadAlarm(robot);
    robot.changes.MarkStatus();
    _transaction.Store(robot.ports.MakeRecord(robot.GetID()));
}

std::vector<PortUse> LoadWatch::ListPortUses(const Robot& robot, const StartJob& job) const
{
    const auto rule = _options.actions.find(job.action);
    const EActionEffect effect = rule == _options.actions.end() ? EActionEffect::None : rule->second.effect;
    std::vector<PortUse> uses;
    for (const bool bFills : {false, true})
    {
        const std::optional<std::string>& place = bFills ? job.to : job.from;
        const std::optional<std::size_t> port =
            IsPortChanged(effect, bFills) && place.has_value() ? robot.ports.FindPortOrNull(*place) : std::nullopt;
        if (port.has_value())
        {
            uses.push_back({*port, bFills});
        }
    }
    return uses;
}

} // namespace ACS::Planning

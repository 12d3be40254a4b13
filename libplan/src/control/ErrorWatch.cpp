#include "control/ErrorWatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

bool IsHeavy(const RobotError& error)
{
    return error.level == EAlarmLevel::Heavy;
}

} // namespace

ErrorWatch::ErrorWatch(EngineState& engine)
    : _room(engine.room),
      _alarms(engine.alarms),
      _transaction(engine.transaction)
{
}

void ErrorWatch::CompareErrors(Robot& robot)
{
    const StateChanged& state = *robot.view.state;
    Errors errors;
    for (const RobotError& error : state.errors)
    {
        const RobotError*& known = errors.try_emplace(error.errorCode, &error).first->second;
        known = IsHeavy(error) && !IsHeavy(*known) ? &error : known;
    }
    std::size_t set = UpdateSet(robot, errors);
    std::vector<std::reference_wrapper<const RobotError>> fresh;
    for (const RobotError& error : state.errors) // in the order of the robot
    {
        const auto found = errors.find(error.errorCode);
        if (found != errors.end() && found->second == &error)
        {
            fresh.emplace_back(error);
        }
    }
    if (fresh.size() + set > MOST_ALARMS)
    {
        std::stable_partition(fresh.begin(), fresh.end(), IsHeavy);
    }
    const auto canSet = [this, &robot, &set] {
        return set < MOST_ALARMS && !_room.IsAlarmShareUsed()
            && robot.view.errors.TryCount(_transaction.GetNow().steady);
    };
    auto next = fresh.begin();
    for (; next != fresh.end() && canSet(); ++next, ++set)
    {
        const RobotError& error = *next;
        _transaction.RaiseAlarm(MakeAlarm(robot.GetID(), error.errorCode, error.level, error.message));
    }
    UpdateSummary(
        robot,
        static_cast<std::size_t>(fresh.end() - next) + state.omittedErrors,
        std::any_of(next, fresh.end(), IsHeavy));
}

std::size_t ErrorWatch::UpdateSet(const Robot& robot, Errors& errors)
{
    const auto isOfError = [&robot](const Alarm& alarm) {
        return alarm.robotID == robot.GetID() && !alarm.errorCode.starts_with(ALARM_PREFIX);
    };
    std::vector<Alarm> alarms;
    std::ranges::copy_if(_alarms.GetAlarms(), std::back_inserter(alarms), isOfError);
    if (alarms.size() > MOST_ALARMS) // from the store of an older version, which had no limit
    {
        _transaction.ReportAlarms(_alarms.ClearIf(isOfError));
        return 0;
    }
    std::size_t set = alarms.size();
    for (const Alarm& alarm : alarms)
    {
        const auto found = errors.find(alarm.errorCode);
        if (found != errors.end())
        {
            const RobotError& error = *found->second;
            _transaction.RaiseAlarm(MakeAlarm(robot.GetID(), error.errorCode, error.level, error.message));
            errors.erase(found);
            continue;
        }
        _transaction.ClearAlarm(alarm);
        set -= _alarms.FindOrNull(alarm) == nullptr ? 1U : 0U;
    }
    return set;
}

void ErrorWatch::UpdateSummary(Robot& robot, std::size_t count, bool bHeavy)
{
    Alarm alarm = MakeAlarm(
        robot.GetID(),
        ALARM_ERRORS,
        bHeavy ? EAlarmLevel::Heavy : EAlarmLevel::Light,
        fmt::format(
            "The robot reports {} more errors than the alarms list{}. Check the robot.",
            count,
            bHeavy ? ", heavy ones among them" : ""));
    if (count == 0)
    {
        _transaction.ClearAlarm(alarm);
        return;
    }
    const Core::SteadyTime now = _transaction.GetNow().steady;
    if (robot.view.errors.TryUpdate(now))
    {
        _transaction.ReportAlarms(_alarms.Update(std::move(alarm), now));
        return;
    }
    _transaction.RaiseAlarm(std::move(alarm));
}

} // namespace ACS::Planning

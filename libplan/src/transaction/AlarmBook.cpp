#include "transaction/AlarmBook.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// Whether both alarms are the same but for the code that the MCS knows.
bool IsEqualHere(const Alarm& alarm, const Alarm& other)
{
    return alarm.IsSameAs(other) && alarm.level == other.level && alarm.message == other.message
        && alarm.stepNo == other.stepNo;
}

} // namespace

void AlarmBook::Restore(std::vector<Alarm> alarms)
{
    _alarms = std::move(alarms);
}

std::vector<ErrorReport> AlarmBook::Raise(Alarm alarm, Core::SteadyTime now)
{
    const Alarm* const setOrNull = FindOrNull(alarm);
    if (setOrNull != nullptr && setOrNull->level == alarm.level)
    {
        _limit.OnRaisedAgain(alarm, now);
        return {};
    }
    const bool bFalls = setOrNull != nullptr && alarm.level != EAlarmLevel::Heavy;
    if (bFalls && !_limit.CanClear(alarm, now))
    {
        _limit.Delay({std::move(alarm), false}, now);
        return {};
    }
    _limit.OnSet(alarm, now);
    return Replace(std::move(alarm));
}

std::vector<ErrorReport> AlarmBook::Update(Alarm alarm, Core::SteadyTime now)
{
    const Alarm* const setOrNull = FindOrNull(alarm);
    if (setOrNull == nullptr || setOrNull->level != alarm.level || IsEqualHere(*setOrNull, alarm))
    {
        return Raise(std::move(alarm), now);
    }
    _limit.OnRaisedAgain(alarm, now);
    return Replace(std::move(alarm));
}

std::vector<ErrorReport> AlarmBook::Clear(const Alarm& alarm, Core::SteadyTime now)
{
    if (FindOrNull(alarm) == nullptr)
    {
        return {};
    }
    if (!_limit.CanClear(alarm, now))
    {
        _limit.Delay({alarm, true}, now);
        return {};
    }
    _limit.OnCleared(alarm, now);
    return ClearIf([&alarm](const Alarm& other) { return other.IsSameAs(alarm); });
}

std::vector<ErrorReport> AlarmBook::ClearIf(const std::function<bool(const Alarm&)>& isCleared)
{
    std::vector<ErrorReport> reports;
    std::erase_if(_alarms, [this, &reports, &isCleared](const Alarm& alarm) {
        const bool bCleared = isCleared(alarm);
        if (bCleared)
        {
            _limit.OnRemoved(alarm);
            reports.push_back({alarm, false});
        }
        return bCleared;
    });
    return reports;
}

std::vector<ErrorReport> AlarmBook::ApplyDelayed(Core::SteadyTime now)
{
    std::vector<ErrorReport> reports;
    for (AlarmRateLimit::Delayed& delayed : _limit.CollectDue(now))
    {
        std::ranges::move(
            delayed.bClear ? Clear(delayed.alarm, now) : Raise(std::move(delayed.alarm), now),
            std::back_inserter(reports));
    }
    return reports;
}

std::optional<Core::SteadyTime> AlarmBook::GetNextDelayedOrNull() const
{
    return _limit.GetNextOrNull();
}

bool AlarmBook::Contains(const Alarm& alarm) const
{
    return std::ranges::any_of(_alarms, [&alarm](const Alarm& other) { return IsEqualHere(other, alarm); });
}

const Alarm* AlarmBook::FindOrNull(const Alarm& alarm) const
{
    const auto found = std::ranges::find_if(_alarms, [&alarm](const Alarm& other) { return other.IsSameAs(alarm); });
    return found == _alarms.end() ? nullptr : &*found;
}

const std::vector<Alarm>& AlarmBook::GetAlarms() const noexcept
{
    return _alarms;
}

std::vector<ErrorReport> AlarmBook::Replace(Alarm alarm)
{
    std::vector<ErrorReport> reports = ClearIf([&alarm](const Alarm& other) { return other.IsSameAs(alarm); });
    if (_mcsCodes.has_value())
    {
        const auto named = _mcsCodes->find(alarm.errorCode);
        alarm.mcsCode = named == _mcsCodes->end() ? alarm.errorCode : named->second;
    }
    reports.push_back({alarm, true});
    _alarms.push_back(std::move(alarm));
    return reports;
}

} // namespace ACS::Planning

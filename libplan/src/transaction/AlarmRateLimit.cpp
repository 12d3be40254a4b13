#include "transaction/AlarmRateLimit.hpp"

#include <algorithm>

namespace ACS::Planning
{

void AlarmRateLimit::OnSet(const Alarm& alarm, Core::SteadyTime now)
{
    if (!IsLimited(alarm))
    {
        return;
    }
    std::erase_if(_entries, [now](const auto& pair) { return IsQuiet(pair.second, now); });
    Entry& entry = _entries[{alarm.robotID, alarm.errorCode}];
    ++entry.sets;
    entry.changedAt = now;
    entry.delayed.reset();
}

void AlarmRateLimit::OnCleared(const Alarm& alarm, Core::SteadyTime now)
{
    if (Entry* entryOrNull = FindOrNull(alarm); entryOrNull != nullptr)
    {
        entryOrNull->changedAt = now;
        entryOrNull->delayed.reset();
    }
}

void AlarmRateLimit::OnRemoved(const Alarm& alarm)
{
    if (Entry* entryOrNull = FindOrNull(alarm); entryOrNull != nullptr)
    {
        entryOrNull->delayed.reset();
    }
}

bool AlarmRateLimit::CanClear(const Alarm& alarm, Core::SteadyTime now) const
{
    const auto found = _entries.find({alarm.robotID, alarm.errorCode});
    return !IsLimited(alarm) || found == _entries.end() || found->second.sets < MOST_SETS
        || (!found->second.delayed.has_value() && now - found->second.changedAt >= QUIET_PERIOD);
}

void AlarmRateLimit::Delay(Delayed delayed, Core::SteadyTime now)
{
    Entry& entry = *FindOrNull(delayed.alarm);
    if (!entry.delayed.has_value() || entry.delayed->bClear != delayed.bClear)
    {
        entry.changedAt = now;
    }
    entry.delayed = std::move(delayed);
}

void AlarmRateLimit::OnRaisedAgain(const Alarm& alarm, Core::SteadyTime now)
{
    Entry* entryOrNull = FindOrNull(alarm);
    if (entryOrNull != nullptr && entryOrNull->delayed.has_value())
    {
        entryOrNull->changedAt = now;
        entryOrNull->delayed.reset();
    }
}

std::vector<AlarmRateLimit::Delayed> AlarmRateLimit::CollectDue(Core::SteadyTime now)
{
    std::vector<Delayed> due;
    for (auto entry = _entries.begin(); entry != _entries.end();)
    {
        Entry& candidate = entry->second;
        if (!candidate.delayed.has_value() || now - candidate.changedAt < QUIET_PERIOD)
        {
            ++entry;
            continue;
        }
        due.push_back(std::move(*candidate.delayed));
        entry = _entries.erase(entry);
    }
    return due;
}

std::optional<Core::SteadyTime> AlarmRateLimit::GetNextOrNull() const
{
    std::optional<Core::SteadyTime> next;
    for (const auto& [key, entry] : _entries)
    {
        if (entry.delayed.has_value())
        {
            const Core::SteadyTime due = entry.changedAt + QUIET_PERIOD;
            next = next.has_value() ? std::min(*next, due) : due;
        }
    }
    return next;
}

bool AlarmRateLimit::IsLimited(const Alarm& alarm)
{
    return !alarm.planID.has_value() && !alarm.jobID.has_value();
}

AlarmRateLimit::Entry* AlarmRateLimit::FindOrNull(const Alarm& alarm)
{
    const auto found = IsLimited(alarm) ? _entries.find({alarm.robotID, alarm.errorCode}) : _entries.end();
    return found == _entries.end() ? nullptr : &found->second;
}

bool AlarmRateLimit::IsQuiet(const Entry& entry, Core::SteadyTime now)
{
    return !entry.delayed.has_value() && now - entry.changedAt >= QUIET_PERIOD;
}

} // namespace ACS::Planning

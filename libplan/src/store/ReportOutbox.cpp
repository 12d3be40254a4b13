#include <acs/core/Uuid.hpp>
#include <acs/plan/ReportOutbox.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::Planning
{

const OutboxEntry& ReportOutbox::Add(Report report, Core::WallTime time, Core::IRandom& random)
{
    ++_lastSequence;
    _entries.push_back({_lastSequence, Core::MakeUUID(random), time, std::move(report)});
    AddToIndex(_entries.back());
    return _entries.back();
}

bool ReportOutbox::TryRemove(std::uint64_t sequence)
{
    const auto found = std::ranges::lower_bound(_entries, sequence, {}, &OutboxEntry::sequence);
    if (found == _entries.end() || found->sequence != sequence)
    {
        return false;
    }
    if (const auto* reportOrNull = std::get_if<ErrorReport>(&found->report); reportOrNull != nullptr)
    {
        --_alarmCount;
        const auto latest = _latestAlarms.find(MakeKey(reportOrNull->alarm));
        if (latest != _latestAlarms.end() && latest->second == sequence)
        {
            _latestAlarms.erase(latest);
        }
    }
    _entries.erase(found);
    return true;
}

void ReportOutbox::Restore(std::vector<OutboxEntry> entries, std::uint64_t lastSequence)
{
    _lastSequence = lastSequence;
    std::ranges::sort(entries, {}, &OutboxEntry::sequence);
    if (!entries.empty())
    {
        _lastSequence = std::max(_lastSequence, entries.back().sequence);
    }
    _entries.assign(std::make_move_iterator(entries.begin()), std::make_move_iterator(entries.end()));
    _latestAlarms.clear();
    _alarmCount = 0;
    std::ranges::for_each(_entries, [this](const OutboxEntry& entry) { AddToIndex(entry); });
}

const std::deque<OutboxEntry>& ReportOutbox::GetUnacknowledged() const noexcept
{
    return _entries;
}

std::size_t ReportOutbox::CountAlarms() const noexcept
{
    return _alarmCount;
}

std::optional<std::uint64_t> ReportOutbox::FindAlarmOrNull(const Alarm& alarm) const
{
    const auto found = _latestAlarms.find(MakeKey(alarm));
    return found == _latestAlarms.end() ? std::nullopt : std::optional(found->second);
}

ReportOutbox::AlarmKey ReportOutbox::MakeKey(const Alarm& alarm)
{
    return {alarm.robotID, alarm.errorCode, alarm.planID, alarm.jobID};
}

void ReportOutbox::AddToIndex(const OutboxEntry& entry)
{
    if (const auto* reportOrNull = std::get_if<ErrorReport>(&entry.report); reportOrNull != nullptr)
    {
        _latestAlarms[MakeKey(reportOrNull->alarm)] = entry.sequence;
        ++_alarmCount;
    }
}

} // namespace ACS::Planning

#include <acs/core/Uuid.hpp>
#include <acs/plan/ReportOutbox.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

const OutboxEntry& ReportOutbox::Add(Report report, Core::WallTime time, Core::IRandom& random)
{
    ++_lastSequence;
    _entries.push_back({_lastSequence, Core::MakeUUID(random), time, std::move(report)});
    return _entries.back();
}

bool ReportOutbox::TryRemove(std::uint64_t sequence)
{
    const auto found = std::ranges::lower_bound(_entries, sequence, {}, &OutboxEntry::sequence);
    if (found == _entries.end() || found->sequence != sequence)
    {
        return false;
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
}

const std::deque<OutboxEntry>& ReportOutbox::GetUnacknowledged() const noexcept
{
    return _entries;
}

} // namespace ACS::Planning

#include "common/trace/TraceQueue.hpp"

#include <utility>

namespace ACS::Apps
{
namespace
{

/// Memory of a queued line besides its text.
constexpr std::size_t ENTRY_BYTES = 96;

} // namespace

TraceQueue::TraceQueue(std::size_t maxBytes)
    : _maxBytes(maxBytes)
{
}

bool TraceQueue::TryPush(std::string line, Core::Now now)
{
    const std::size_t size = ENTRY_BYTES + line.size();
    if (_bytes + size > _maxBytes)
    {
        ++_lost;
        return false;
    }
    _bytes += size;
    _entries.push_back({std::move(line), now, TakeLost()});
    return true;
}

TraceQueue::Entries TraceQueue::TakeEntries()
{
    _bytes = 0;
    return std::exchange(_entries, {});
}

std::uint64_t TraceQueue::TakeLost() noexcept
{
    return std::exchange(_lost, 0);
}

bool TraceQueue::IsEmpty() const noexcept
{
    return _entries.empty();
}

bool TraceQueue::HasLost() const noexcept
{
    return _lost > 0;
}

} // namespace ACS::Apps

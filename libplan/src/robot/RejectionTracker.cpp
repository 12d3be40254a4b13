#include "robot/RejectionTracker.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

void RejectionTracker::Add(std::string reason, std::size_t limit)
{
    _count = std::min(_count + 1, limit);
    _state = _count < limit ? ERejection::Delayed : ERejection::Exhausted;
    _reason = std::move(reason);
}

bool RejectionTracker::TryRetry()
{
    return std::exchange(_state, ERejection::None) != ERejection::None;
}

bool RejectionTracker::TryReset()
{
    _state = ERejection::None;
    _reason.clear();
    return std::exchange(_count, 0) > 0;
}

ERejection RejectionTracker::GetState() const noexcept
{
    return _state;
}

std::size_t RejectionTracker::GetCount() const noexcept
{
    return _count;
}

const std::string& RejectionTracker::GetReason() const noexcept
{
    return _reason;
}

} // namespace ACS::Planning

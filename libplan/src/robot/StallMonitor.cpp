#include "robot/StallMonitor.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ACS::Planning
{

StallMonitor::Update StallMonitor::OnProgress(
    std::optional<DriveProgress> progressOrNull,
    std::optional<std::size_t> releasedCountOrNull,
    Core::SteadyTime now)
{
    Update update;
    const bool bProgress = progressOrNull != _progress;
    _progress = std::move(progressOrNull);
    update.bStallEnded = bProgress && std::exchange(_bStalled, false);
    const bool bWatched = _releasedCount.has_value();
    if (!bProgress && releasedCountOrNull == _releasedCount)
    {
        return update;
    }
    _releasedCount = releasedCountOrNull;
    if (releasedCountOrNull.has_value())
    {
        _since = now;
        update.timer = EStallTimer::Start;
    }
    else if (bWatched)
    {
        update.timer = EStallTimer::Cancel;
    }
    return update;
}

bool StallMonitor::TryStall()
{
    _bStalled = _bStalled || _releasedCount.has_value();
    return _releasedCount.has_value();
}

bool StallMonitor::IsStalled() const noexcept
{
    return _bStalled;
}

Core::Duration StallMonitor::GetTimeWithoutProgress(Core::SteadyTime now) const noexcept
{
    return now - _since;
}

Core::Duration StallMonitor::GetLimit(Core::Duration timeout, double edgeSeconds)
{
    constexpr double EDGE_FACTOR = 3;
    constexpr std::chrono::duration<double> LONGEST = std::chrono::hours(24);
    const std::chrono::duration<double> limit(edgeSeconds * EDGE_FACTOR);
    return std::max<Core::Duration>(timeout, std::chrono::ceil<std::chrono::milliseconds>(std::min(limit, LONGEST)));
}

} // namespace ACS::Planning

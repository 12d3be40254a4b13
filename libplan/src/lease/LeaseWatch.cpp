#include <acs/plan/LeaseWatch.hpp>

#include <utility>

namespace ACS::Planning
{

LeaseWatch::LeaseWatch(std::string config)
    : _config(std::move(config))
{
}

bool LeaseWatch::ShouldTake(const LeaseState& state, Core::SteadyTime now)
{
    if (!_seen.has_value() || *_seen != state)
    {
        _seen = state;
        _seenSince = now;
    }
    return state.bReleased || (now - _seenSince >= state.duration && !IsOtherConfig());
}

const std::optional<LeaseState>& LeaseWatch::GetSeenOrNull() const noexcept
{
    return _seen;
}

bool LeaseWatch::IsOtherConfig() const noexcept
{
    return _seen.has_value() && !_seen->bReleased && _seen->config != _config;
}

} // namespace ACS::Planning

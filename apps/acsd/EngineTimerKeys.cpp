#include "EngineTimerKeys.hpp"

namespace ACS::Acsd
{

EngineTimerKeys::EngineTimerKeys(std::uint64_t first)
    : _first(first)
{
}

std::uint64_t EngineTimerKeys::GetKey(const Planning::EngineTimer& timer)
{
    const auto [entry, bNew] = _keys.try_emplace(timer, _first + _keys.size());
    if (bNew)
    {
        _timers.emplace(entry->second, timer);
    }
    return entry->second;
}

const Planning::EngineTimer& EngineTimerKeys::GetTimer(std::uint64_t key) const
{
    return _timers.at(key);
}

} // namespace ACS::Acsd

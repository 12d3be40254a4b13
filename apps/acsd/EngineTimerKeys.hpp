#pragma once

#include <acs/plan/EngineAction.hpp>

#include <cstdint>
#include <map>

namespace ACS::Acsd
{

/// The numbers by which a TimerSet knows the engine's timers, given as they come: the engine has few, and the same again.
class EngineTimerKeys final
{
    std::uint64_t _first;
    std::map<Planning::EngineTimer, std::uint64_t> _keys;
    std::map<std::uint64_t, Planning::EngineTimer> _timers;

public:
    explicit EngineTimerKeys(std::uint64_t first);

    [[nodiscard]] std::uint64_t GetKey(const Planning::EngineTimer& timer);

    /// Of a key that was given.
    [[nodiscard]] const Planning::EngineTimer& GetTimer(std::uint64_t key) const;
};

} // namespace ACS::Acsd

#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>

namespace ACS::Testing
{

/// The same numbers on every run (splitmix64).
class SeededRandom final : public Core::IRandom
{
    std::uint64_t _state;

public:
    explicit SeededRandom(std::uint64_t seed = 1)
        : _state(seed)
    {
    }

    [[nodiscard]] std::uint64_t GetNext() override
    {
        _state += 0x9E3779B97F4A7C15U;
        std::uint64_t value = _state;
        value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
        value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
        return value ^ (value >> 31U);
    }
};

} // namespace ACS::Testing

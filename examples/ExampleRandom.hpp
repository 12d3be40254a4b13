#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>

/// The random source of the lessons. No library of the SDK has one of its own: programs bring it, as here, and tests bring
/// one that repeats itself.
class ExampleRandom final : public ACS::Core::IRandom
{
    std::random_device _device;

public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return (std::uint64_t{_device()} << 32U) | _device();
    }
};

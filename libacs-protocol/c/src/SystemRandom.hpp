#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>

namespace ACS::CInterface
{

/// The random source of the operating system, which callers of C need not supply.
class SystemRandom final : public Core::IRandom
{
    std::random_device _device;

public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        constexpr unsigned HALF = 32;
        return (std::uint64_t{_device()} << HALF) | _device();
    }
};

} // namespace ACS::CInterface

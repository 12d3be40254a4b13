#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>

namespace ACS::Apps
{

/// A random engine seeded by the system's random device, so that programs that are started together get different numbers.
class SystemRandom final : public Core::IRandom
{
    std::mt19937_64 _engine;

public:
    SystemRandom();

    [[nodiscard]] std::uint64_t GetNext() override;
};

} // namespace ACS::Apps

#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>

namespace ACS::Apps
{

/// An engine seeded by the system's random device, so that no two programs started together draw the same numbers.
class SystemRandom final : public Core::IRandom
{
    std::mt19937_64 _engine;

public:
    SystemRandom();

    [[nodiscard]] std::uint64_t GetNext() override;
};

} // namespace ACS::Apps

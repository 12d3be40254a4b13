#pragma once

#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>
#include <string_view>

namespace ACS::VdaSim
{

/// Random numbers of one vehicle: the same for the same seed and name, whatever other vehicles do.
class VehicleRandom final : public Core::IRandom
{
    std::mt19937_64 _engine;

public:
    VehicleRandom(std::uint64_t seed, std::string_view name);

    [[nodiscard]] std::uint64_t GetNext() override;
};

} // namespace ACS::VdaSim

#include "vda-sim/VehicleRandom.hpp"

#include <vector>

namespace ACS::VdaSim
{

VehicleRandom::VehicleRandom(std::uint64_t seed, std::string_view name)
{
    constexpr unsigned HALF = 32;
    std::vector<std::uint32_t> parts{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> HALF)};
    for (const char letter : name)
    {
        parts.push_back(static_cast<unsigned char>(letter));
    }
    std::seed_seq sequence(parts.begin(), parts.end());
    _engine.seed(sequence);
}

std::uint64_t VehicleRandom::GetNext()
{
    return _engine();
}

} // namespace ACS::VdaSim

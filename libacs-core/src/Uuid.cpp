#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <cstdint>

namespace ACS::Core
{

namespace
{

constexpr std::uint64_t VERSION_MASK = 0xF000U;
constexpr std::uint64_t VERSION_4 = 0x4000U;
constexpr std::uint64_t VARIANT_MASK = 0xC000'0000'0000'0000U;
constexpr std::uint64_t VARIANT_RFC = 0x8000'0000'0000'0000U;
constexpr std::uint64_t NODE_MASK = 0xFFFF'FFFF'FFFFU;

} // namespace

std::string MakeUUID(IRandom& random)
{
    const std::uint64_t high = (random.GetNext() & ~VERSION_MASK) | VERSION_4;
    const std::uint64_t low = (random.GetNext() & ~VARIANT_MASK) | VARIANT_RFC;
    return fmt::format(
        "{:08x}-{:04x}-{:04x}-{:04x}-{:012x}",
        high >> 32U,
        (high >> 16U) & 0xFFFFU,
        high & 0xFFFFU,
        low >> 48U,
        low & NODE_MASK);
}

} // namespace ACS::Core

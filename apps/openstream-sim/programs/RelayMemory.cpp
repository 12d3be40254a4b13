#include "programs/RelayMemory.hpp"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::uint32_t BYTE_MASK = 0xFF;
constexpr std::size_t LONG_BYTES = 4;

struct ValueRange
{
    double lowest;
    double highest;
};

/// From the lowest signed to the highest unsigned value.
ValueRange GetRange(ERelayWidth width)
{
    if (width == ERelayWidth::Bit)
    {
        return {0.0, 1.0};
    }
    if (width == ERelayWidth::Float)
    {
        constexpr double LIMIT = std::numeric_limits<float>::max();
        return {-LIMIT, LIMIT};
    }
    const double values = std::exp2(static_cast<double>(GetBytes(width) * BITS_PER_BYTE));
    return {-values / 2.0, values - 1.0};
}

} // namespace

std::uint32_t RelayMemory::ReadBytes(const RelayBlock& block, std::size_t first, std::size_t count) const
{
    assert(first + count <= RELAY_BYTES);
    const auto found = _blocks.find(block);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; found != _blocks.end() && i < count; ++i)
    {
        bits |= static_cast<std::uint32_t>(found->second[first + i]) << (BITS_PER_BYTE * i);
    }
    return bits;
}

void RelayMemory::WriteBytes(const RelayBlock& block, std::size_t first, std::size_t count, std::uint32_t bits)
{
    assert(first + count <= RELAY_BYTES);
    std::vector<std::uint8_t>& bytes = _blocks[block];
    bytes.resize(RELAY_BYTES);
    for (std::size_t i = 0; i < count; ++i)
    {
        bytes[first + i] = static_cast<std::uint8_t>((bits >> (BITS_PER_BYTE * i)) & BYTE_MASK);
    }
}

double RelayMemory::Read(const RelayName& name) const
{
    const std::uint32_t bits = ReadBytes(name.block, GetFirstByte(name), GetBytes(name.width));
    switch (name.width)
    {
        case ERelayWidth::Bit:
            return static_cast<double>((bits >> (name.number % BITS_PER_BYTE)) & 1U);
        case ERelayWidth::Byte:
            return static_cast<double>(static_cast<std::int8_t>(bits));
        case ERelayWidth::Word:
            return static_cast<double>(static_cast<std::int16_t>(bits));
        case ERelayWidth::Float:
        {
            // Bits written through another width may be an infinity or a NaN, which JSON does not have.
            const auto value = std::bit_cast<float>(bits);
            return std::isfinite(value) ? static_cast<double>(value) : 0.0;
        }
        case ERelayWidth::Long:
        default:
            return static_cast<double>(static_cast<std::int32_t>(bits));
    }
}

Core::Result<void> RelayMemory::Write(const RelayName& name, double value)
{
    const ValueRange range = GetRange(name.width);
    const bool bWhole = name.width == ERelayWidth::Float || std::trunc(value) == value;
    if (!bWhole || !(value >= range.lowest && value <= range.highest))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            "value",
            fmt::format("a number from {} to {}", range.lowest, range.highest),
            fmt::format("{}", value));
    }
    const std::size_t first = GetFirstByte(name);
    if (name.width == ERelayWidth::Float)
    {
        WriteBytes(name.block, first, LONG_BYTES, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
        return {};
    }
    auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    if (name.width == ERelayWidth::Bit)
    {
        const std::uint32_t mask = 1U << (name.number % BITS_PER_BYTE);
        const std::uint32_t others = ReadBytes(name.block, first, 1) & ~mask;
        bits = others | (bits != 0 ? mask : 0U);
    }
    WriteBytes(name.block, first, GetBytes(name.width), bits);
    return {};
}

std::int32_t RelayMemory::ReadS32(const RelayBlock& block, std::size_t firstByte) const
{
    return static_cast<std::int32_t>(ReadBytes(block, firstByte, LONG_BYTES));
}

void RelayMemory::WriteU32(const RelayBlock& block, std::size_t firstByte, std::uint32_t value)
{
    WriteBytes(block, firstByte, LONG_BYTES, value);
}

} // namespace ACS::OpenStreamSim

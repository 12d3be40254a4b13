#pragma once

#include "programs/RelayName.hpp"
#include <acs/core/Result.hpp>

#include <cstdint>
#include <map>
#include <vector>

namespace ACS::OpenStreamSim
{

/// The controller's relays: bytes, little-endian, initially zero. A block is allocated when it is first written.
class RelayMemory
{
    std::map<RelayBlock, std::vector<std::uint8_t>> _blocks;

public:
    /// The value, integers signed; the name must lie inside its block.
    [[nodiscard]] double Read(const RelayName& name) const;

    /// The name must lie inside its block. Refuses a value that the width cannot hold; an integer may be signed or unsigned.
    [[nodiscard]] Core::Result<void> Write(const RelayName& name, double value);

    /// 32 bits from any byte; they must lie inside the block.
    [[nodiscard]] std::int32_t ReadS32(const RelayBlock& block, std::size_t firstByte) const;
    void WriteU32(const RelayBlock& block, std::size_t firstByte, std::uint32_t value);

private:
    [[nodiscard]] std::uint32_t ReadBytes(const RelayBlock& block, std::size_t first, std::size_t count) const;
    void WriteBytes(const RelayBlock& block, std::size_t first, std::size_t count, std::uint32_t bits);
};

} // namespace ACS::OpenStreamSim

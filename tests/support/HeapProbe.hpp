#pragma once

#include <cstddef>
#include <cstdint>

namespace ACS::Testing
{

/// What a test program takes from the heap, through operator new and, in what is linked into it statically, through
/// malloc. Counts from the start of the program, for one
/// thread.
class HeapProbe
{
public:
    HeapProbe() = delete;

    /// Blocks taken so far, those given back included; moving a block to grow it counts.
    [[nodiscard]] static std::uint64_t GetBlockCount() noexcept;

    /// Bytes held at present, as the allocator rounds them.
    [[nodiscard]] static std::int64_t GetLiveBytes() noexcept;
};

} // namespace ACS::Testing

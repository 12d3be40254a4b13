#pragma once

#include <cstddef>
#include <cstdint>

namespace ACS::Testing
{

/// Heap use of a test program through operator new and, in what is linked into it statically, through
/// malloc. Counts from the start of the program, for one thread.
class HeapProbe
{
public:
    HeapProbe() = delete;

    /// Number of allocations so far, including freed ones; moving a block to grow it counts.
    [[nodiscard]] static std::uint64_t GetBlockCount() noexcept;

    /// Bytes in use, as the allocator rounds them.
    [[nodiscard]] static std::int64_t GetLiveBytes() noexcept;
};

} // namespace ACS::Testing

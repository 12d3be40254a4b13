#include "HeapProbe.hpp"

#include <cstdlib>
#include <malloc.h>
#include <new>

// The linker's --wrap gives these two names to each of malloc, calloc, realloc, aligned_alloc and free.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming,cppcoreguidelines-no-malloc)
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
/// The caller checks for null.
using Block = void*;

extern "C"
{
    Block __real_malloc(std::size_t size);
    Block __real_calloc(std::size_t count, std::size_t size);
    Block __real_realloc(void* blockOrNull, std::size_t size);
    Block __real_aligned_alloc(std::size_t alignment, std::size_t size);
    void __real_free(void* blockOrNull);
}

namespace
{

constinit std::uint64_t takenBlocks = 0;
constinit std::int64_t liveBytes = 0;

Block Count(void* blockOrNull) noexcept
{
    if (blockOrNull != nullptr)
    {
        ++takenBlocks;
        liveBytes += static_cast<std::int64_t>(malloc_usable_size(blockOrNull));
    }
    return blockOrNull;
}

void Release(void* blockOrNull) noexcept
{
    liveBytes -= static_cast<std::int64_t>(malloc_usable_size(blockOrNull));
    __real_free(blockOrNull);
}

} // namespace

extern "C"
{
    Block __wrap_malloc(std::size_t size)
    {
        return Count(__real_malloc(size));
    }

    Block __wrap_calloc(std::size_t count, std::size_t size)
    {
        return Count(__real_calloc(count, size));
    }

    Block __wrap_realloc(void* blockOrNull, std::size_t size)
    {
        liveBytes -= static_cast<std::int64_t>(malloc_usable_size(blockOrNull));
        return Count(__real_realloc(blockOrNull, size));
    }

    /// The allocator that Asio uses for its handlers.
    Block __wrap_aligned_alloc(std::size_t alignment, std::size_t size)
    {
        return Count(__real_aligned_alloc(alignment, size));
    }

    void __wrap_free(void* blockOrNull)
    {
        Release(blockOrNull);
    }
}

void* operator new(std::size_t size)
{
    void* block = Count(__real_malloc(size == 0 ? 1 : size));
    if (block == nullptr)
    {
        throw std::bad_alloc();
    }
    return block;
}

void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    return Count(__real_malloc(size == 0 ? 1 : size));
}

void operator delete(void* blockOrNull) noexcept
{
    Release(blockOrNull);
}

void operator delete(void* blockOrNull, std::size_t /*size*/) noexcept
{
    Release(blockOrNull);
}
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming,cppcoreguidelines-no-malloc)

namespace ACS::Testing
{

std::uint64_t HeapProbe::GetBlockCount() noexcept
{
    return takenBlocks;
}

std::int64_t HeapProbe::GetLiveBytes() noexcept
{
    return liveBytes;
}

} // namespace ACS::Testing

#pragma once

#include <cstddef>
#include <new>

namespace ACS::Json
{

/// Where the pools of RapidJSON get their chunks. Throws std::bad_alloc: RapidJSON does not check for a null pointer.
struct PoolMemory
{
    using Block = void*;

    [[nodiscard]] static Block Malloc(std::size_t size)
    {
        return ::operator new(size);
    }

    static void Free(void* blockOrNull) noexcept
    {
        ::operator delete(blockOrNull);
    }
};

} // namespace ACS::Json

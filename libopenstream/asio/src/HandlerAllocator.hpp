#pragma once

#include "HandlerMemory.hpp"

#include <cstddef>

namespace ACS::OpenStreamAsio
{

/// A HandlerMemory as an allocator of the standard library. The names are the standard's.
template <typename T>
class HandlerAllocator
{
public:
    using value_type = T;
    using pointer = T*;

private:
    template <typename TOther>
    friend class HandlerAllocator;

    HandlerMemory* _memory;

public:
    explicit HandlerAllocator(HandlerMemory& memory) noexcept
        : _memory(&memory)
    {
    }

    template <typename TOther>
    // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions): an allocator's rebinding is implicit.
    HandlerAllocator(const HandlerAllocator<TOther>& other) noexcept
        : _memory(other._memory)
    {
    }

    [[nodiscard]] pointer allocate(std::size_t count) // NOLINT(readability-identifier-naming)
    {
        static_assert(alignof(T) <= alignof(std::max_align_t));
        return static_cast<T*>(_memory->Allocate(count * sizeof(T)));
    }

    void deallocate(T* memory, std::size_t /*count*/) noexcept // NOLINT(readability-identifier-naming)
    {
        _memory->Deallocate(memory);
    }

    bool operator==(const HandlerAllocator&) const noexcept = default;
};

} // namespace ACS::OpenStreamAsio

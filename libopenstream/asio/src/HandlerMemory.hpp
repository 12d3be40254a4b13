#pragma once

#include <array>
#include <cstddef>
#include <new>

namespace ACS::OpenStreamAsio
{

/// Room for what Asio keeps about the one write that is in flight, so that no write takes it from the heap: what Asio keeps
/// back by itself serves writes and timers in turns, and fits one of them only. One thread; outlives its handlers.
class HandlerMemory
{
public:
    using Room = void*; ///< Never null.

private:
    static constexpr std::size_t BLOCK_BYTES = 512;

    struct Block
    {
        alignas(std::max_align_t) std::array<std::byte, BLOCK_BYTES> bytes{};
        bool bInUse = false;
    };

    std::array<Block, 2> _blocks; ///< The operation, and the call of its handler.

public:
    HandlerMemory() = default;
    HandlerMemory(const HandlerMemory&) = delete;
    HandlerMemory& operator=(const HandlerMemory&) = delete;
    ~HandlerMemory() = default;

    /// From the heap where it does not fit.
    [[nodiscard]] Room Allocate(std::size_t size)
    {
        for (Block& block : _blocks)
        {
            if (!block.bInUse && size <= block.bytes.size())
            {
                block.bInUse = true;
                return block.bytes.data();
            }
        }
        return ::operator new(size);
    }

    void Deallocate(void* memory) noexcept
    {
        for (Block& block : _blocks)
        {
            if (memory == block.bytes.data())
            {
                block.bInUse = false;
                return;
            }
        }
        ::operator delete(memory);
    }
};

} // namespace ACS::OpenStreamAsio

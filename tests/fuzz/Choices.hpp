#pragma once

#include <cstddef>
#include <cstdint>

namespace ACS::Fuzz
{

/// Reads choices from the bytes of the fuzzer; zeros when they are used up.
class Choices
{
    const std::uint8_t* _data;
    std::size_t _size;
    std::size_t _used = 0;

public:
    Choices(const std::uint8_t* data, std::size_t size)
        : _data(data),
          _size(size)
    {
    }

    [[nodiscard]] bool IsUsedUp() const
    {
        return _used >= _size;
    }

    [[nodiscard]] std::uint8_t TakeByte()
    {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-bounds-pointer-arithmetic)
        return IsUsedUp() ? std::uint8_t{0} : _data[_used++];
    }

    /// 0 to limit - 1.
    [[nodiscard]] std::uint32_t Take(std::uint32_t limit)
    {
        return TakeByte() % limit;
    }
};

} // namespace ACS::Fuzz

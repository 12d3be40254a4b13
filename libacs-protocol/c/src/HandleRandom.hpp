#pragma once

#include <acs/c/acs_protocol.h>
#include <acs/core/IRandom.hpp>

#include <cstdint>
#include <random>

namespace ACS::CInterface
{

/// The random source of a handle: the function of the caller, or that of the operating system.
class HandleRandom final : public Core::IRandom
{
    acs_random _functionOrNull;
    void* _contextOrNull;
    std::random_device _device;

public:
    HandleRandom(acs_random functionOrNull, void* contextOrNull)
        : _functionOrNull(functionOrNull),
          _contextOrNull(contextOrNull)
    {
    }

    [[nodiscard]] std::uint64_t GetNext() override
    {
        if (_functionOrNull != nullptr)
        {
            return _functionOrNull(_contextOrNull);
        }
        constexpr unsigned HALF = 32;
        return (std::uint64_t{_device()} << HALF) | _device();
    }
};

} // namespace ACS::CInterface

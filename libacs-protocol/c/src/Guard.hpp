#pragma once

#include <acs/c/acs_protocol.h>

#include <cstdint>
#include <new>
#include <utility>

namespace ACS::CInterface
{

/// Calls what a function of the C interface does. Every exception ends here.
template <typename TCall>
[[nodiscard]] std::int32_t Guard(TCall&& call) noexcept
{
    try
    {
        return std::forward<TCall>(call)();
    }
    catch (const std::bad_alloc&)
    {
        return ACS_ERROR_MEMORY;
    }
    catch (...)
    {
        return ACS_ERROR_INTERNAL;
    }
}

} // namespace ACS::CInterface

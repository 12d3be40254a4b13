#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>

namespace ACS::Core
{

/// A source of random numbers: the system's in programs, a seeded one in tests. Not shared between threads.
class ACS_API IRandom
{
public:
    IRandom() = default;
    IRandom(const IRandom&) = delete;
    IRandom& operator=(const IRandom&) = delete;
    virtual ~IRandom() = default;

    /// 64 uniformly distributed bits.
    [[nodiscard]] virtual std::uint64_t GetNext() = 0;
};

} // namespace ACS::Core

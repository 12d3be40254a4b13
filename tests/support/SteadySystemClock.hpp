#pragma once

#include <acs/core/Now.hpp>

#include <chrono>

namespace ACS::Testing
{

/// The real clocks, for real sockets.
class SteadySystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

} // namespace ACS::Testing

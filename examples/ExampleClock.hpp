#pragma once

#include <acs/core/Now.hpp>

#include <chrono>

/// The clocks of the system. No library of the SDK reads them: programs bring them, as here, and tests bring a manual clock.
class ExampleClock final : public ACS::Core::IClock
{
public:
    [[nodiscard]] ACS::Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

#pragma once

#include <acs/core/Now.hpp>

namespace ACS::Acsd
{

/// The system's clocks; the steady one also counts the time for which the machine was suspended. A lease ends in that time too.
class BootClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override;
};

} // namespace ACS::Acsd

#pragma once

#include <acs/core/Now.hpp>

namespace ACS::Apps
{

/// The clocks of the system. Only programs use it; libraries receive the time as an argument.
class SystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override;
};

} // namespace ACS::Apps

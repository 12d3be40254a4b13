#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <optional>
#include <string_view>

namespace ACS::Apps
{

/// Offset of local time from UTC: that of the system's time zone, daylight saving time included, or a fixed one.
class LocalOffset final
{
    std::optional<std::chrono::minutes> _fixedOrNull;

public:
    /// The time zone of the system.
    LocalOffset() = default;
    explicit LocalOffset(std::chrono::minutes fixed);

    /// "system", "Z", or an offset from "-12:00" to "+14:00".
    [[nodiscard]] static Core::Result<LocalOffset> Parse(std::string_view text);

    /// Minutes to add to UTC at that moment.
    [[nodiscard]] std::chrono::minutes GetAt(Core::WallTime time) const;
};

} // namespace ACS::Apps

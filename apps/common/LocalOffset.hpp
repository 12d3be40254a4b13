#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <optional>
#include <string_view>

namespace ACS::Apps
{

/// How far local time is ahead of UTC: the zone of the system, followed through summer time, or a fixed distance.
class LocalOffset final
{
    std::optional<std::chrono::minutes> _fixedOrNull;

public:
    /// The zone of the system.
    LocalOffset() = default;
    explicit LocalOffset(std::chrono::minutes fixed);

    /// "system", "Z", or a distance from "-12:00" to "+14:00".
    [[nodiscard]] static Core::Result<LocalOffset> Parse(std::string_view text);

    /// Minutes to add to UTC at that moment.
    [[nodiscard]] std::chrono::minutes GetAt(Core::WallTime time) const;
};

} // namespace ACS::Apps

#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// A point in time and the sender's UTC offset.
struct Timestamp
{
    WallTime time;                  ///< In UTC.
    std::chrono::minutes offset{0}; ///< Local time minus UTC.

    bool operator==(const Timestamp&) const = default;
};

/// Reads an ISO 8601 date and time: no or 1 to 9 digits of a second's fraction, `Z`, `+09:00`, `+0900` or no offset
/// (then defaultOffset), `T` and `Z` in either case. Years 1678 to 2261, which 64-bit nanoseconds can hold; no leap
/// seconds. Fails with ECoreError::InvalidTimestamp.
[[nodiscard]] ACS_API Result<Timestamp> ParseTimestamp(std::string_view text, std::chrono::minutes defaultOffset = {});

/// Local time with offset, as MCS-ACS writes it (section 2): 2025-07-02T21:00:00.123+09:00. Cuts below a millisecond.
/// The offset is that of the site, less than 24 hours either way.
[[nodiscard]] ACS_API std::string FormatLocal(WallTime time, std::chrono::minutes offset);

/// Length of a text of FormatLocal in bytes.
inline constexpr std::size_t LOCAL_TIME_LENGTH = 29;
/// A text of FormatLocal, without a zero byte at its end.
using LocalTimeText = std::array<char, LOCAL_TIME_LENGTH>;

/// Like FormatLocal, without a heap allocation.
[[nodiscard]] ACS_API LocalTimeText PrintLocal(WallTime time, std::chrono::minutes offset);

/// UTC, as VDA5050 writes it: 2025-07-02T12:00:00.123Z. Cuts below a millisecond.
[[nodiscard]] ACS_API std::string FormatUTC(WallTime time);

} // namespace ACS::Core

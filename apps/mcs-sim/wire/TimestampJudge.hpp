#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// How a readable timestamp differs from that of section 6.1, 2025-07-02T21:00:00.123+09:00 (R19).
enum class ETimestampDeviation : std::uint8_t
{
    NoOffset,
    Utc,          ///< `Z` instead of an offset.
    Fraction,     ///< Other than three digits.
    OtherSpelling ///< Such as `+0900` and `t`.
};

inline constexpr std::size_t TIMESTAMP_DEVIATION_COUNT = 4;

/// For people: "timestamp without offset"; never empty.
[[nodiscard]] std::string_view GetMeaning(ETimestampDeviation deviation);

/// By ETimestampDeviation.
using TimestampCounts = std::array<std::uint64_t, TIMESTAMP_DEVIATION_COUNT>;

/// Counts the messages of the ACS whose timestamp the codec accepts, although it is not as specified. Pure.
class TimestampJudge
{
    TimestampCounts _counts{};

public:
    /// Any text of the ACS. Returns a line for people per deviation that was not seen before.
    [[nodiscard]] std::vector<std::string> OnText(std::string_view text);

    [[nodiscard]] const TimestampCounts& GetCounts() const noexcept;
};

} // namespace ACS::McsSim

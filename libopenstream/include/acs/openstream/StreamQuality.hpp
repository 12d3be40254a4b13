#pragma once

#include <cstdint>

namespace ACS::OpenStream
{

/// Gaps between samples, in milliseconds. A percentile is the upper bound of its class; a class spans at most a sixteenth
/// of its value.
struct GapStatistics
{
    std::uint64_t count = 0; ///< Number of gaps.
    double mean = 0.0;       ///< 0 without gaps, like the following.
    double p50 = 0.0;        ///< Median.
    double p99 = 0.0;        ///< 99 of 100 gaps are at most this long.
    double p999 = 0.0;       ///< 999 of 1000 gaps are at most this long.
    double largest = 0.0;    ///< The longest gap.

    bool operator==(const GapStatistics&) const = default;
};

/// Quality of a MONITOR since its ack.
struct StreamQuality
{
    std::uint64_t samples = 0; ///< Data lines that were received.
    std::uint64_t missing = 0; ///< Periods without a sample, according to `ts`. A late sample is not missing.
    GapStatistics byServer;    ///< Differences between consecutive `ts`: the sampling of the controller. Whole ms.
    GapStatistics byArrival;   ///< Differences between arrivals: includes the network and this machine.
    /// Share of the last 100 periods (fewer at first) whose sample arrived at most half a period late after the previous
    /// one; 0 to 1, and 1 before the first sample.
    double inTime = 1.0;

    bool operator==(const StreamQuality&) const = default;
};

} // namespace ACS::OpenStream

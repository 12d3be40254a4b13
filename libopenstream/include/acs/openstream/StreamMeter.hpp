#pragma once

#include <acs/core/Now.hpp>

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::OpenStream
{

/// Gaps between samples, in milliseconds. Percentiles are the upper bounds of classes that are at most a sixteenth wide.
struct GapFigures
{
    std::uint64_t count = 0;
    double mean = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    double p999 = 0.0;
    double largest = 0.0;

    bool operator==(const GapFigures&) const = default;
};

/// How good a MONITOR is, since its ack.
struct StreamQuality
{
    std::uint64_t samples = 0;
    std::uint64_t missing = 0; ///< Periods that `ts` skipped.
    GapFigures byServer;       ///< Between the ts of neighbours: how evenly the controller samples. Whole ms.
    GapFigures byArrival;      ///< Between arrivals: what the network and this machine make of it.
    /// The share of the last 100 periods (fewer at first) whose sample came, and no more than half a period late after the
    /// one before; 0 to 1, 1 before the first.
    double inTime = 1.0;

    bool operator==(const StreamQuality&) const = default;
};

/// Gaps in fixed room: sixteen classes an octave of microseconds.
class GapHistogram
{
    static constexpr std::size_t OCTAVES = 37; ///< Up to days.
    static constexpr std::size_t CLASSES = 16;

    std::array<std::uint64_t, OCTAVES * CLASSES> _counts{};
    std::uint64_t _count = 0;
    double _sum = 0.0;
    double _largest = 0.0;

    [[nodiscard]] double GetPercentile(double share) const;

public:
    /// Of 0 or more; what is not is left out.
    void Add(double milliseconds);
    void Clear();
    [[nodiscard]] GapFigures GetFigures() const;
};

/// Measures a stream by its samples.
class StreamMeter
{
    static constexpr std::size_t WINDOW = 100;

    std::chrono::milliseconds _period{1};
    std::uint64_t _samples = 0;
    std::uint64_t _missing = 0;
    GapHistogram _byServer;
    GapHistogram _byArrival;
    std::optional<double> _lastTs;
    Core::SteadyTime _lastAt;
    std::bitset<WINDOW> _inTime;
    std::size_t _next = 0;
    std::size_t _filled = 0;

    void Note(bool bInTime);

public:
    /// A MONITOR begins, or another one replaces it: all figures begin anew.
    void Begin(std::chrono::milliseconds period);

    /// Returns how many periods were skipped before this sample.
    std::uint64_t Add(double ts, Core::SteadyTime receivedAt);

    [[nodiscard]] StreamQuality GetQuality() const;
};

} // namespace ACS::OpenStream

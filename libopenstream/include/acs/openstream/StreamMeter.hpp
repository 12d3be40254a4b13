#pragma once

#include <acs/core/Now.hpp>
#include <acs/openstream/GapHistogram.hpp>

#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::OpenStream
{

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

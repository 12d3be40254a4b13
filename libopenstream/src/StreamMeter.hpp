#pragma once

#include "GapHistogram.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/StreamQuality.hpp>

#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::OpenStream
{

/// Measures the quality of a MONITOR by its samples.
class StreamMeter
{
    static constexpr std::size_t WINDOW = 100;

    std::chrono::milliseconds _period{1};
    std::uint64_t _samples = 0;
    std::uint64_t _missing = 0;
    GapHistogram _byServer;
    GapHistogram _byArrival;
    std::optional<double> _lastTs;
    double _due = 0.0; ///< When the last sample was due, by the grid of the server's samples.
    Core::SteadyTime _lastAt;
    std::bitset<WINDOW> _inTime;
    std::size_t _next = 0;
    std::size_t _filled = 0;

public:
    /// A MONITOR starts or replaces another one: resets all values.
    void Begin(std::chrono::milliseconds period);

    /// Returns the number of periods that were skipped before this sample. A late sample does not count as skipped periods,
    /// nor does a controller whose clock is off by up to 5 %.
    std::uint64_t Add(double ts, Core::SteadyTime receivedAt);

    [[nodiscard]] StreamQuality GetQuality() const;

private:
    [[nodiscard]] std::uint64_t CountSkipped(double ts);
    void Note(bool bInTime);
};

} // namespace ACS::OpenStream

#pragma once

#include <acs/openstream/StreamQuality.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace ACS::OpenStream
{

/// A histogram of fixed size: sixteen classes per octave of microseconds.
class GapHistogram
{
    static constexpr std::size_t OCTAVES = 37; ///< Up to days.
    static constexpr std::size_t CLASSES = 16;

    std::array<std::uint64_t, OCTAVES * CLASSES> _counts{};
    std::uint64_t _count = 0;
    double _sum = 0.0;
    double _largest = 0.0;

public:
    /// Negative values are ignored.
    void Add(double milliseconds);
    [[nodiscard]] GapStatistics GetStatistics() const;

private:
    [[nodiscard]] double GetPercentile(double share) const;
};

} // namespace ACS::OpenStream

#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

namespace ACS::Apps
{

/// The lines that wait for the thread of a TraceWriter, with limited memory. Lines without room are lost and counted; the
/// next entry states their number. Not thread-safe.
class TraceQueue
{
public:
    struct Entry
    {
        std::string line;
        Core::Now now;
        std::uint64_t lostBefore = 0; ///< Lines for which the queue had no room.
    };

    using Entries = std::deque<Entry>;

private:
    std::size_t _maxBytes;
    Entries _entries;
    std::size_t _bytes = 0;
    std::uint64_t _lost = 0; ///< Number of lost lines that no entry states yet.

public:
    explicit TraceQueue(std::size_t maxBytes);

    /// False if the line is lost.
    [[nodiscard]] bool TryPush(std::string line, Core::Now now);

    [[nodiscard]] Entries TakeEntries();
    /// The number of lost lines that no entry states; no later entry states them either.
    [[nodiscard]] std::uint64_t TakeLost() noexcept;

    [[nodiscard]] bool IsEmpty() const noexcept;
    /// Whether lines are lost that no entry states.
    [[nodiscard]] bool HasLost() const noexcept;
};

} // namespace ACS::Apps

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The newest events, bounded in number and bytes, each as the text of a server-sent event. Their numbers increase by one.
/// Pure.
class EventRing final
{
public:
    struct Limits
    {
        std::size_t maxEvents = 4'096;
        std::size_t maxBytes = 8U * 1024U * 1024U; ///< A longer event is kept alone.
    };

private:
    Limits _limits;
    std::uint64_t _lastID;
    std::size_t _bytes = 0;
    std::deque<std::string> _events; ///< The last of them has _lastID.

public:
    /// The first event has the number after lastID. Runs of a program have different numbers if lastID is the time in
    /// microseconds.
    EventRing(std::uint64_t lastID, Limits limits);

    /// Returns the number of the event.
    std::uint64_t Add(std::string_view type, std::string_view json);

    [[nodiscard]] std::uint64_t GetLastID() const noexcept;

    /// Whether every event after this number is known. False also for a number that no event of this run has had.
    [[nodiscard]] bool HasAllAfter(std::uint64_t eventID) const noexcept;

    /// The events after this number, which becomes that of the last one returned. Returns as many as fit into maxBytes, at
    /// least one; empty if there is none. HasAllAfter must be true.
    [[nodiscard]] std::string TakeAfter(std::uint64_t& eventID, std::size_t maxBytes) const;
};

} // namespace ACS::Acsd

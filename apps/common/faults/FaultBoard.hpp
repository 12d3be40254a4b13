#pragma once

#include <acs/core/Now.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Apps
{

/// A fault has begun or ended.
template <typename TFault>
struct FaultChange
{
    TFault fault;
    bool bBegun = false;
    std::string_view reason; ///< Why it ended; a literal.

    bool operator==(const FaultChange&) const = default;
};

/// The faults of one simulated machine: those that wait for their time or place, and the active ones with their ends. Several
/// of a kind may be active; each ends independently. Does no I/O and reads no clock. TFault derives from FaultBase.
template <typename TFault>
class FaultBoard
{
public:
    /// Maximum number of active and waiting faults. The owner must check it before Add.
    static constexpr std::size_t MAX_FAULTS = 1000;

private:
    using Kind = typename TFault::Kind;
    using Changes = std::vector<FaultChange<TFault>>;

    struct Entry
    {
        TFault fault;
        bool bWaitsForPlace = false;
        bool bActive = false;
        Core::SteadyTime begunAt;
        std::optional<Core::SteadyTime> due; ///< Time of its begin or, while active, of its end.
        std::uint32_t uses = 0;
    };

    std::vector<Entry> _entries;

public:
    [[nodiscard]] std::size_t CountFaults() const noexcept
    {
        return _entries.size();
    }

    /// Adds a fault; it begins immediately unless it has a delay or a place.
    void Add(TFault fault, Core::SteadyTime now, Changes& out)
    {
        assert(_entries.size() < MAX_FAULTS);
        Entry& entry = _entries.emplace_back();
        entry.fault = std::move(fault);
        entry.bWaitsForPlace = !entry.fault.place.empty();
        if (entry.bWaitsForPlace)
        {
            return;
        }
        entry.due = now + entry.fault.delay;
        // Only this entry: checking all of them for each addition would be quadratic.
        if (*entry.due <= now)
        {
            Begin(entry, now, out);
            if (TryEnd(entry, now, out))
            {
                _entries.pop_back();
            }
        }
    }

    /// Ends the faults of the kind (nullopt: all), also those that have not begun. Returns their number.
    std::size_t End(std::optional<Kind> kindOrNull, std::string_view reason, Changes& out)
    {
        return std::erase_if(_entries, [&](const Entry& entry) {
            const bool bEnds = !kindOrNull.has_value() || entry.fault.kind == *kindOrNull;
            if (bEnds && entry.bActive)
            {
                out.push_back({entry.fault, false, reason});
            }
            return bEnds;
        });
    }

    void OnPlace(std::string_view place, Core::SteadyTime now, Changes& out)
    {
        for (Entry& entry : _entries)
        {
            if (entry.bWaitsForPlace && entry.fault.place == place)
            {
                entry.bWaitsForPlace = false;
                entry.due = now + entry.fault.delay;
            }
        }
        OnTime(now, out);
    }

    /// Begins and ends the faults that are due.
    void OnTime(Core::SteadyTime now, Changes& out)
    {
        for (Entry& entry : _entries)
        {
            if (!entry.bActive && entry.due.has_value() && *entry.due <= now)
            {
                Begin(entry, *entry.due, out);
            }
        }
        std::erase_if(_entries, [&](Entry& entry) { return TryEnd(entry, now, out); });
    }

    /// The time at which OnTime is due next; nullopt if no fault waits for a time.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const
    {
        std::optional<Core::SteadyTime> next;
        for (const Entry& entry : _entries)
        {
            if (entry.due.has_value() && (!next.has_value() || *entry.due < *next))
            {
                next = entry.due;
            }
        }
        return next;
    }

    /// The latest active fault of the kind; null if there is none.
    [[nodiscard]] const TFault* FindOrNull(Kind kind) const
    {
        return FindOrNull(kind, [](const TFault&) { return true; });
    }

    /// The latest active fault of the kind for which the predicate is true; null if there is none.
    template <typename TPredicate>
    [[nodiscard]] const TFault* FindOrNull(Kind kind, TPredicate isWanted) const
    {
        const auto found = std::find_if(_entries.rbegin(), _entries.rend(), [&](const Entry& entry) {
            return entry.bActive && entry.fault.kind == kind && isWanted(entry.fault);
        });
        return found != _entries.rend() ? &found->fault : nullptr;
    }

    /// Counts one use of the fault and ends it after the last one. The fault must be a result of FindOrNull.
    void Use(const TFault& fault, Changes& out)
    {
        const auto found = std::ranges::find(_entries, &fault, [](const Entry& entry) { return &entry.fault; });
        assert(found != _entries.end());
        ++found->uses;
        // Without a number of uses and a duration the fault is used once.
        const std::uint32_t whileItLasts = found->fault.lasts.has_value() ? UINT32_MAX : 1;
        if (found->uses >= found->fault.maxUses.value_or(whileItLasts))
        {
            out.push_back({found->fault, false, "it is used up"});
            if (!TryRepeat(*found))
            {
                _entries.erase(found);
            }
        }
    }

    [[nodiscard]] bool IsActive(Kind kind) const
    {
        return FindOrNull(kind) != nullptr;
    }

    /// Whether no fault is active or waiting.
    [[nodiscard]] bool IsEmpty() const noexcept
    {
        return _entries.empty();
    }

private:
    static void Begin(Entry& entry, Core::SteadyTime now, Changes& out)
    {
        entry.bActive = true;
        entry.begunAt = now;
        entry.due = entry.fault.lasts.has_value() ? std::optional(now + *entry.fault.lasts) : std::nullopt;
        out.push_back({entry.fault, true, {}});
    }

    /// Ends an active fault if it is due or takes effect once. True if it must be removed, false if it continues or is repeated.
    [[nodiscard]] static bool TryEnd(Entry& entry, Core::SteadyTime now, Changes& out)
    {
        const bool bOver = entry.bActive && entry.due.has_value() && *entry.due <= now;
        if (bOver)
        {
            out.push_back({entry.fault, false, "its time is over"});
        }
        const bool bDone = entry.bActive && entry.fault.bOnce;
        return (bOver || bDone) && !TryRepeat(entry);
    }

    /// Schedules the next begin of a repeated fault; false if the fault is not repeated.
    [[nodiscard]] static bool TryRepeat(Entry& entry)
    {
        if (!entry.fault.every.has_value())
        {
            return false;
        }
        entry.bActive = false;
        entry.uses = 0;
        entry.due = entry.begunAt + *entry.fault.every;
        return true;
    }
};

} // namespace ACS::Apps

#pragma once

#include "vda-sim/Fault.hpp"
#include <acs/core/Now.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// Told: a fault has begun, or has ended.
struct FaultChange
{
    Fault fault;
    bool bBegun = false;
    std::string_view reason; ///< Why it ended; a literal.

    bool operator==(const FaultChange&) const = default;
};

using FaultChanges = std::vector<FaultChange>;

/// The faults of one vehicle: which wait for their time or their node, which are active, when they end. Pure. Several
/// of one kind may be active; each ends by itself.
class FaultBoard
{
    struct Entry
    {
        Fault fault;
        bool bWaitsForNode = false;
        bool bActive = false;
        std::optional<Core::SteadyTime> due; ///< When it begins, or while active ends.
        std::uint32_t uses = 0;
    };

    std::vector<Entry> _entries;

public:
    /// Active and to come. The owner asks first: one more is its mistake.
    static constexpr std::size_t MAX_FAULTS = 1000;
    [[nodiscard]] std::size_t CountFaults() const noexcept;

    /// Begins at once where neither a delay nor a node says otherwise.
    void Add(Fault fault, Core::SteadyTime now, FaultChanges& out);

    /// Ends those of the kind (absent: all), also those that have not begun; how many.
    std::size_t End(std::optional<EFaultKind> kindOrNull, std::string_view reason, FaultChanges& out);

    void OnNode(std::string_view nodeID, Core::SteadyTime now, FaultChanges& out);

    /// Begins and ends what is due.
    void OnTime(Core::SteadyTime now, FaultChanges& out);

    /// When OnTime has something to do next.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// The youngest active one of the kind.
    [[nodiscard]] const Fault* FindOrNull(EFaultKind kind) const;

    /// The youngest active one of the kind for which the predicate is true.
    template <typename TPredicate>
    [[nodiscard]] const Fault* FindOrNull(EFaultKind kind, TPredicate isWanted) const
    {
        const auto found = std::find_if(_entries.rbegin(), _entries.rend(), [&](const Entry& entry) {
            return entry.bActive && entry.fault.kind == kind && isWanted(entry.fault);
        });
        return found != _entries.rend() ? &found->fault : nullptr;
    }

    /// It has had its effect once; ends where that was the last time. The fault is one that FindOrNull gave.
    void Use(const Fault& fault, FaultChanges& out);

    [[nodiscard]] bool IsActive(EFaultKind kind) const;
    /// Neither active nor to come.
    [[nodiscard]] bool IsEmpty() const noexcept;

private:
    static void Begin(Entry& entry, Core::SteadyTime now, FaultChanges& out);
    /// Whether an active one has come to its end; told then.
    [[nodiscard]] static bool TryEnd(const Entry& entry, Core::SteadyTime now, FaultChanges& out);
};

} // namespace ACS::VdaSim

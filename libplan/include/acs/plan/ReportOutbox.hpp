#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/Report.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace ACS::Planning
{

/// The durable reports that the MCS has not acknowledged, oldest first.
class ReportOutbox
{
    std::deque<OutboxEntry> _entries;
    std::uint64_t _lastSequence = 0;

public:
    /// Assigns the report its sequence number, transactionID and time. The reference is valid until the next call.
    const OutboxEntry& Add(Report report, Core::WallTime time, Core::IRandom& random);

    /// False if there is no entry of this number, for example because it was acknowledged twice.
    [[nodiscard]] bool TryRemove(std::uint64_t sequence);

    /// Replaces all entries by those that a store returned.
    void Restore(std::vector<OutboxEntry> entries, std::uint64_t lastSequence);

    [[nodiscard]] const std::deque<OutboxEntry>& GetUnacknowledged() const noexcept;
};

} // namespace ACS::Planning

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

/// The reports that the MCS has not acknowledged, oldest first. The only outbox: a session in front of it holds no more
/// than its window of messages under way.
class ReportOutbox
{
    std::deque<OutboxEntry> _entries;
    std::uint64_t _lastSequence = 0;

public:
    /// Gives the report its number, transactionID and time.
    const OutboxEntry& Add(Report report, Core::WallTime time, Core::IRandom& random);

    /// False where there is no entry of this number (acknowledged twice).
    [[nodiscard]] bool TryRemove(std::uint64_t sequence);

    /// What a store gave back. Replaces everything.
    void Restore(std::vector<OutboxEntry> entries, std::uint64_t lastSequence);

    [[nodiscard]] const std::deque<OutboxEntry>& GetUnacknowledged() const noexcept;
};

} // namespace ACS::Planning

#pragma once

#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/Report.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ACS::Planning
{

/// Whether the store works, and while it fails what waits for it: changes that are not stored, and reports that must not be
/// sent before those are.
class StoreBacklog
{
    enum class EState : std::uint8_t
    {
        Working,
        Waiting,   ///< Failed; the retry timer runs.
        Due,       ///< The next changes are an attempt.
        Attempted, ///< Whether it works again shows when the next call comes without a failure.
    };

    EState _state = EState::Working;
    std::vector<StoreChange> _changes;
    std::vector<OutboxEntry> _reports;

public:
    void OnFailed() noexcept;
    void OnRetryDue() noexcept;
    /// After a restart whose store failed before: the next changes are an attempt.
    void RestoreFailing() noexcept;
    /// At the beginning of a call. True: the attempt of the call before was successful.
    [[nodiscard]] bool TryRecover() noexcept;
    /// Each attempt costs as much as the whole backlog: only new plans and the retry timer make one.
    [[nodiscard]] bool IsWorthTrying(std::span<const StoreChange> changes) const;
    /// A batch leaves. True: the store has failed before, and the retry is to be timed.
    [[nodiscard]] bool TryBeginAttempt() noexcept;

    void Add(std::vector<StoreChange> changes);
    [[nodiscard]] std::vector<StoreChange> CollectChanges();
    void HoldBack(OutboxEntry report);
    [[nodiscard]] std::vector<OutboxEntry> CollectReports();

    [[nodiscard]] bool IsFailing() const noexcept;
    /// The reports that are held back are a part of the outbox, in the same order.
    [[nodiscard]] bool IsHeldBack(const OutboxEntry& report) const;
    [[nodiscard]] std::size_t CountHeldBack() const noexcept;
};

} // namespace ACS::Planning

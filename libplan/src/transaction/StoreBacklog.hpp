#pragma once

#include <acs/plan/EngineAction.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/Report.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Whether the store works. While it fails: the changes to be stored, and the reports that must not be sent before them.
class StoreBacklog
{
public:
    static constexpr std::size_t MOST_WITHHELD = 1'000;

private:
    enum class EState : std::uint8_t
    {
        Working,
        Waiting,   ///< Failed; the retry timer runs.
        Due,       ///< The end of the call is an attempt.
        Attempted, ///< It works again if no failure is reported before the next call.
    };

    EState _state = EState::Working;
    std::vector<StoreChange> _changes;
    std::vector<SendReport> _reports;
    std::vector<ReplyCommand> _withheld;
    std::set<std::string, std::less<>> _refusedPlanIDs;

public:
    void OnFailed() noexcept;
    /// True: the attempt was successful, and the store failed after it. The retry timer of the attempt still runs.
    [[nodiscard]] bool TryFailAttempt() noexcept;
    void OnRetryDue() noexcept;
    /// The store was failing before the restart: the end of the call is an attempt.
    void RestoreFailing() noexcept;
    /// At the beginning of a call. True: the attempt of the previous call was successful.
    [[nodiscard]] bool TryRecover() noexcept;
    /// An attempt writes the whole backlog, so only new plans and the retry timer trigger one.
    [[nodiscard]] bool IsWorthTrying(std::span<const StoreChange> changes) const;
    /// At the end of a call, with a batch for the store or with nothing to store. True: the store was failing; start the timer.
    [[nodiscard]] bool TryBeginAttempt() noexcept;

    void Add(std::vector<StoreChange> changes);
    [[nodiscard]] std::vector<StoreChange> CollectChanges();
    /// Drops the report that it replaces, if that is held back too.
    void HoldBack(SendReport report);
    [[nodiscard]] std::vector<SendReport> CollectReports();

    /// The answer is true only after the next successful write: it refuses what may be stored (EPlanningError::StoreOutcomeUnknown)
    /// and be executed after a crash, or accepts a control whose effects are not stored. Beyond MOST_WITHHELD the oldest one is
    /// dropped: its request has no answer.
    void Withhold(ReplyCommand reply);
    /// The refusal of this plan is withheld.
    void NoteUnknown(std::string planID);
    [[nodiscard]] std::vector<ReplyCommand> CollectWithheld();
    [[nodiscard]] bool HasWithheld() const noexcept;
    [[nodiscard]] bool HasUnknown(std::string_view planID) const;

    [[nodiscard]] bool IsFailing() const noexcept;
    /// Reports that are held back are also in the outbox, in the same order.
    [[nodiscard]] bool IsHeldBack(const OutboxEntry& report) const;
    [[nodiscard]] std::size_t CountHeldBack() const noexcept;
};

} // namespace ACS::Planning

#pragma once

#include "plan/ActivePlan.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Planning
{

/// All plans: active ones, the queue of those without a robot, and the history. States change here only, by the transition
/// tables. What must be stored is collected (CollectProgress) or returned.
class PlanBook
{
public:
    using ActivePlans = std::map<std::string, std::unique_ptr<ActivePlan>, std::less<>>;
    using Queue = std::map<QueueKey, ActivePlan*>;

private:
    const EngineOptions& _options;
    ActivePlans _active;
    Queue _queue;
    std::vector<std::unique_ptr<ActivePlan>> _ended; ///< In the present call: references to them stay valid.
    std::unordered_map<std::string, PlanRecord> _finished;
    std::deque<std::string> _finishedOrder;
    std::vector<PlanRecord> _replaced; ///< In the present call: finished plans whose ID a new plan reuses.
    std::set<std::string> _progressed; ///< By id; not stored yet.
    std::uint64_t _lastSequence = 0;
    std::uint64_t _lastStoredSequence = 0;
    Core::Duration _age{}; ///< Of the queue (PlanProgress::queuedAt).
    std::optional<Core::SteadyTime> _calledAt;
    std::size_t _reportsAhead = 0; ///< Of all active plans.

public:
    /// The options must outlive the book.
    explicit PlanBook(const EngineOptions& options);

    /// Plans that the previous call added are stored, and those that it ended are history.
    void BeginCall(Core::SteadyTime now);
    /// The progress of each plan that changed since the last time.
    [[nodiscard]] std::vector<PlanProgressed> CollectProgress();

    /// Numbers the plan and queues it. Returns what must be stored; the removal of a finished plan with the same ID comes first.
    [[nodiscard]] std::vector<StoreChange> Accept(std::unique_ptr<ActivePlan> plan, Core::WallTime now);
    /// After a restart; the record is not finished. The plan is not queued.
    [[nodiscard]] ActivePlan& RestoreActive(PlanRecord record);
    [[nodiscard]] std::vector<StoreChange> RestoreFinished(PlanRecord record);
    /// Removes a plan that could not be stored: it was never accepted.
    void Withdraw(std::string_view planID);
    /// Restores the finished plans that withdrawn plans of this call had replaced. Returns what must be stored.
    [[nodiscard]] std::vector<StoreChange> RestoreReplaced();
    [[nodiscard]] bool IsReplaced(std::uint64_t sequence) const;

    void Enqueue(ActivePlan& plan);
    void Dequeue(const ActivePlan& plan);

    /// Of a plan in the queue or with an offer.
    void SetPriority(ActivePlan& plan, std::int32_t priority);

    /// These return the previous state. The transition must be in its table.
    EPlanState Change(ActivePlan& plan, EPlanState state, std::string message, Core::WallTime now);
    EStepState ChangeStep(ActivePlan& plan, std::size_t index, EStepState state);
    /// Of the present job.
    EJobState ChangeJob(ActivePlan& plan, EJobState state);
    /// The plan's progress must be stored.
    void MarkProgressed(const std::string& planID);
    /// Whether the plan can change to this final state.
    [[nodiscard]] static bool CanEnd(const ActivePlan& plan, EPlanState state);
    /// A plan in a final state becomes history; references to it stay valid until the end of the call. Returns what must be
    /// stored: the removal of the oldest finished plans.
    [[nodiscard]] std::vector<StoreChange> End(ActivePlan& plan);

    [[nodiscard]] const ActivePlans& GetActive() const noexcept;
    [[nodiscard]] const Queue& GetQueue() const noexcept;
    /// The first queued plan after this one, or of all, that was accepted before this call: only those are stored.
    [[nodiscard]] ActivePlan* FindNextStoredOrNull(const ActivePlan* afterOrNull) const;
    /// Whether the plan was accepted before this call.
    [[nodiscard]] bool IsOfEarlierCall(const ActivePlan& plan) const noexcept;
    [[nodiscard]] ActivePlan* FindActiveOrNull(std::string_view planID) const;
    [[nodiscard]] PlanRecord* FindFinishedOrNull(std::string_view planID);
    [[nodiscard]] const PlanRecord* FindFinishedOrNull(std::string_view planID) const;
    /// Of an active or a finished plan.
    [[nodiscard]] const PlanRecord* FindRecordOrNull(std::string_view planID) const;
    /// Finished plans, at most limit, those that ended last first.
    [[nodiscard]] std::vector<std::reference_wrapper<const PlanRecord>> ListFinished(std::size_t limit) const;
    /// In progress, offered to a robot, or paused with a robot and an open control, which may let it move again.
    [[nodiscard]] bool IsAnyRunning() const;
    /// The maximum number of reports that the active plans still allow (ReportForecast).
    [[nodiscard]] std::size_t GetReportsAhead() const noexcept;

private:
    [[nodiscard]] QueueKey MakeQueueKey(const PlanRecord& record) const;
    /// Of the queue.
    [[nodiscard]] std::chrono::milliseconds GetAge() const;
    /// The queue is at least as old as the plan shows.
    void RestoreAge(const PlanProgress& progress);
    [[nodiscard]] std::vector<StoreChange> Remember(PlanRecord record);
};

} // namespace ACS::Planning

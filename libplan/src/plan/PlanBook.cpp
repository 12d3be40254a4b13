#include "plan/PlanBook.hpp"

#include "plan/ReportForecast.hpp"
#include <acs/plan/PlanTransitions.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

PlanBook::PlanBook(const EngineOptions& options)
    : _options(options)
{
}

void PlanBook::BeginCall(Core::SteadyTime now)
{
    _age += now - _calledAt.value_or(now);
    _calledAt = now;
    _ended.clear();
    _replaced.clear();
    _lastStoredSequence = _lastSequence;
}

std::vector<PlanProgressed> PlanBook::CollectProgress()
{
    std::vector<PlanProgressed> changes;
    for (const std::string& planID : std::exchange(_progressed, {}))
    {
        PlanRecord& record = _active.contains(planID) ? _active.find(planID)->second->record : _finished.at(planID);
        record.progress.storedAt = GetAge();
        changes.push_back({planID, record.progress});
    }
    return changes;
}

std::vector<StoreChange> PlanBook::Accept(std::unique_ptr<ActivePlan> plan, Core::WallTime now)
{
    PlanRecord& record = plan->record;
    record.sequence = ++_lastSequence;
    record.acceptedAt = now;
    record.progress.queuedAt = GetAge();
    for (const Step& step : record.plan.steps)
    {
        record.progress.steps.push_back(
            {EStepState::Pending, std::vector<EJobState>(step.jobs.size(), EJobState::Pending)});
    }
    plan->key = MakeQueueKey(record);
    _reportsAhead += CountReportsAhead(record.progress);
    std::vector<StoreChange> changes;
    if (const auto finished = _finished.find(record.plan.planID); finished != _finished.end())
    {
        changes.emplace_back(PlanRemoved{finished->second.sequence});
        _replaced.push_back(std::move(finished->second));
        _finished.erase(finished);
        std::erase(_finishedOrder, record.plan.planID);
    }
    changes.emplace_back(PlanAdded{record});
    Enqueue(*plan);
    std::string planID = record.plan.planID;
    _active.emplace(std::move(planID), std::move(plan));
    return changes;
}

ActivePlan& PlanBook::RestoreActive(PlanRecord record)
{
    _lastSequence = std::max(_lastSequence, record.sequence);
    _lastStoredSequence = _lastSequence;
    RestoreAge(record.progress);
    auto plan = std::make_unique<ActivePlan>();
    plan->record = std::move(record);
    plan->key = MakeQueueKey(plan->record);
    _reportsAhead += CountReportsAhead(plan->record.progress);
    std::string planID = plan->record.plan.planID;
    return *_active.emplace(std::move(planID), std::move(plan)).first->second;
}

std::vector<StoreChange> PlanBook::RestoreFinished(PlanRecord record)
{
    _lastSequence = std::max(_lastSequence, record.sequence);
    RestoreAge(record.progress);
    return Remember(std::move(record));
}

void PlanBook::Withdraw(std::string_view planID)
{
    if (const auto found = _active.find(planID); found != _active.end())
    {
        assert(!found->second->robot.has_value());
        Dequeue(*found->second);
        _reportsAhead -= CountReportsAhead(found->second->record.progress);
        _active.erase(found);
    }
}

std::vector<StoreChange> PlanBook::RestoreReplaced()
{
    std::vector<StoreChange> changes;
    for (PlanRecord& record : std::exchange(_replaced, {}))
    {
        std::ranges::move(Remember(std::move(record)), std::back_inserter(changes));
    }
    return changes;
}

bool PlanBook::IsReplaced(std::uint64_t sequence) const
{
    return std::ranges::count(_replaced, sequence, &PlanRecord::sequence) > 0;
}

void PlanBook::Enqueue(ActivePlan& plan)
{
    _queue.emplace(plan.key, &plan);
}

void PlanBook::Dequeue(const ActivePlan& plan)
{
    _queue.erase(plan.key);
}

void PlanBook::SetPriority(ActivePlan& plan, std::int32_t priority)
{
    const bool bQueued = _queue.contains(plan.key);
    Dequeue(plan);
    plan.record.progress.priority = priority;
    plan.key = MakeQueueKey(plan.record);
    if (bQueued)
    {
        Enqueue(plan);
    }
    MarkProgressed(plan.record.plan.planID);
}

EPlanState PlanBook::Change(ActivePlan& plan, EPlanState state, std::string message, Core::WallTime now)
{
    PlanProgress& progress = plan.record.progress;
    assert(CanChange(progress.state, state));
    if (state == EPlanState::InProgress && !progress.startedAt.has_value())
    {
        progress.startedAt = now;
    }
    if (IsFinal(state))
    {
        progress.endedAt = now;
    }
    progress.message = std::move(message);
    MarkProgressed(plan.record.plan.planID);
    _reportsAhead = _reportsAhead + CountReportsAhead(state) - CountReportsAhead(progress.state);
    return std::exchange(progress.state, state);
}

EStepState PlanBook::ChangeStep(ActivePlan& plan, std::size_t index, EStepState state)
{
    EStepState& current = plan.record.progress.steps[index].state;
    assert(CanChange(current, state));
    MarkProgressed(plan.record.plan.planID);
    _reportsAhead = _reportsAhead + CountReportsAhead(state) - CountReportsAhead(current);
    return std::exchange(current, state);
}

EJobState PlanBook::ChangeJob(ActivePlan& plan, EJobState state)
{
    EJobState& current = plan.record.progress.steps[plan.step].jobs[plan.job];
    assert(CanChange(current, state));
    MarkProgressed(plan.record.plan.planID);
    _reportsAhead = _reportsAhead + CountReportsAhead(state) - CountReportsAhead(current);
    return std::exchange(current, state);
}

void PlanBook::MarkProgressed(const std::string& planID)
{
    _progressed.insert(planID);
}

bool PlanBook::CanEnd(const ActivePlan& plan, EPlanState state)
{
    return CanChange(plan.record.progress.state, state);
}

std::vector<StoreChange> PlanBook::End(ActivePlan& plan)
{
    assert(IsFinal(plan.record.progress.state));
    Dequeue(plan);
    _reportsAhead -= CountReportsAhead(plan.record.progress); // of steps that were not begun
    std::vector<StoreChange> changes = Remember(plan.record);
    const auto found = _active.find(plan.record.plan.planID);
    assert(found != _active.end());
    _ended.push_back(std::move(found->second));
    _active.erase(found);
    return changes;
}

const PlanBook::ActivePlans& PlanBook::GetActive() const noexcept
{
    return _active;
}

const PlanBook::Queue& PlanBook::GetQueue() const noexcept
{
    return _queue;
}

ActivePlan* PlanBook::FindNextStoredOrNull(const ActivePlan* afterOrNull) const
{
    auto next = afterOrNull == nullptr ? _queue.begin() : _queue.upper_bound(afterOrNull->key);
    next = std::find_if(next, _queue.end(), [this](const auto& entry) { return IsOfEarlierCall(*entry.second); });
    return next == _queue.end() ? nullptr : next->second;
}

bool PlanBook::IsOfEarlierCall(const ActivePlan& plan) const noexcept
{
    return plan.record.sequence <= _lastStoredSequence;
}

ActivePlan* PlanBook::FindActiveOrNull(std::string_view planID) const
{
    const auto found = _active.find(planID);
    return found == _active.end() ? nullptr : found->second.get();
}

PlanRecord* PlanBook::FindFinishedOrNull(std::string_view planID)
{
    const auto found = _finished.find(std::string(planID));
    return found == _finished.end() ? nullptr : &found->second;
}

const PlanRecord* PlanBook::FindFinishedOrNull(std::string_view planID) const
{
    const auto found = _finished.find(std::string(planID));
    return found == _finished.end() ? nullptr : &found->second;
}

const PlanRecord* PlanBook::FindRecordOrNull(std::string_view planID) const
{
    const ActivePlan* activeOrNull = FindActiveOrNull(planID);
    return activeOrNull != nullptr ? &activeOrNull->record : FindFinishedOrNull(planID);
}

std::vector<std::reference_wrapper<const PlanRecord>> PlanBook::ListFinished(std::size_t limit) const
{
    std::vector<std::reference_wrapper<const PlanRecord>> records;
    records.reserve(std::min(limit, _finishedOrder.size()));
    for (auto planID = _finishedOrder.rbegin(); planID != _finishedOrder.rend() && records.size() < limit; ++planID)
    {
        records.emplace_back(_finished.at(*planID));
    }
    return records;
}

std::size_t PlanBook::GetReportsAhead() const noexcept
{
    return _reportsAhead;
}

bool PlanBook::IsAnyRunning() const
{
    return std::ranges::any_of(_active, [](const auto& entry) {
        const ActivePlan& plan = *entry.second;
        const PlanProgress& progress = plan.record.progress;
        const bool bMayMove =
            progress.state == EPlanState::Paused && plan.robot.has_value() && progress.control.has_value();
        return progress.state == EPlanState::InProgress || IsOffered(plan) || bMayMove;
    });
}

/// Time in the queue counts as priority, continuously: of two plans the same one is always ahead, so keys never change.
QueueKey PlanBook::MakeQueueKey(const PlanRecord& record) const
{
    const std::int64_t given = record.GetPriorityOrNull().value_or(_options.defaultPriority);
    const std::int64_t priority = _options.bLowerPriorityFirst ? -given : given;
    const std::int64_t ageing = _options.queueAgeing.count();
    if (ageing == 0)
    {
        return {-priority, record.sequence};
    }
    return {record.progress.queuedAt.count() - priority * ageing, record.sequence};
}

std::chrono::milliseconds PlanBook::GetAge() const
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(_age);
}

void PlanBook::RestoreAge(const PlanProgress& progress)
{
    _age = std::max<Core::Duration>({_age, progress.queuedAt, progress.storedAt});
}

std::vector<StoreChange> PlanBook::Remember(PlanRecord record)
{
    std::vector<StoreChange> changes;
    const std::string planID = record.plan.planID;
    _finished.insert_or_assign(planID, std::move(record));
    _finishedOrder.push_back(planID);
    // A plan with unstored progress is not removed yet.
    while (_finishedOrder.size() > _options.finishedPlansKept && !_progressed.contains(_finishedOrder.front()))
    {
        const auto oldest = _finished.find(_finishedOrder.front());
        changes.emplace_back(PlanRemoved{oldest->second.sequence});
        _finished.erase(oldest);
        _finishedOrder.pop_front();
    }
    return changes;
}

} // namespace ACS::Planning

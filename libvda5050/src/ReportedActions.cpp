#include "ReportedActions.hpp"

#include "OrderErrors.hpp"
#include "StateRoom.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace ACS::VDA5050
{

bool ReportedAction::IsInstant() const noexcept
{
    return scope == EActionScope::Instant;
}

bool ReportedAction::IsEnded() const noexcept
{
    return IsTerminal(machine.GetStatus());
}

bool ReportedAction::IsRunningInOrder() const noexcept
{
    return !IsInstant() && bStarted && !IsEnded();
}

ReportedActions::Counts ReportedActions::Measure(const ReportedAction& held)
{
    Counts counts{};
    const auto set = [&counts](ECount count, bool bCounts) {
        counts.at(static_cast<std::size_t>(count)) = bCounts ? 1U : 0U;
    };
    const bool bRuns = held.IsRunningInOrder();
    set(ECount::Open, !held.IsInstant() && !held.IsEnded());
    set(ECount::Running, bRuns);
    set(ECount::RunningBlocking, bRuns && held.action.blockingType != EBlockingType::None);
    set(ECount::RunningHard, bRuns && held.action.blockingType == EBlockingType::Hard);
    set(ECount::Instant, held.IsInstant());
    if (held.IsInstant())
    {
        counts.at(static_cast<std::size_t>(ECount::InstantBytes)) = MeasureActionState(held.machine.GetState());
    }
    return counts;
}

void ReportedActions::Count(const ReportedAction& held)
{
    std::ranges::transform(_counts, Measure(held), _counts.begin(), std::plus<>());
}

void ReportedActions::Discount(const ReportedAction& held)
{
    std::ranges::transform(_counts, Measure(held), _counts.begin(), std::minus<>());
}

std::size_t ReportedActions::Get(ECount count) const noexcept
{
    return _counts[static_cast<std::size_t>(count)];
}

ReportedAction& ReportedActions::Add(ReportedAction held)
{
    const Iterator position = _held.insert(_held.end(), std::move(held));
    const bool bNew = _index.emplace(position->action.actionID, position).second;
    assert(bNew);
    static_cast<void>(bNew);
    Count(*position);
    return *position;
}

ReportedAction* ReportedActions::FindOrNull(std::string_view actionID)
{
    const auto found = _index.find(actionID);
    return found == _index.end() ? nullptr : &*found->second;
}

bool ReportedActions::TrySetStatus(ReportedAction& held, EActionStatus status, std::string resultDescription)
{
    resultDescription.resize(CutForeignText(resultDescription).size());
    Discount(held);
    const bool bSet = held.machine.TrySet(status, std::move(resultDescription));
    Count(held);
    return bSet;
}

void ReportedActions::MarkStarted(ReportedAction& held)
{
    Discount(held);
    held.bStarted = true;
    Count(held);
}

ReportedActions::Iterator ReportedActions::Erase(Iterator position)
{
    Discount(*position);
    _index.erase(position->action.actionID);
    return _held.erase(position);
}

std::size_t ReportedActions::GetSize() const noexcept
{
    return _held.size();
}

std::size_t ReportedActions::CountInstant() const noexcept
{
    return Get(ECount::Instant);
}

std::size_t ReportedActions::GetInstantBytes() const noexcept
{
    return Get(ECount::InstantBytes);
}

std::size_t ReportedActions::CountOpen() const noexcept
{
    return Get(ECount::Open);
}

std::size_t ReportedActions::CountRunning() const noexcept
{
    return Get(ECount::Running);
}

std::size_t ReportedActions::CountRunningBlocking() const noexcept
{
    return Get(ECount::RunningBlocking);
}

std::size_t ReportedActions::CountRunningHard() const noexcept
{
    return Get(ECount::RunningHard);
}

ReportedActions::Iterator ReportedActions::begin() noexcept
{
    return _held.begin();
}

ReportedActions::Iterator ReportedActions::end() noexcept
{
    return _held.end();
}

ReportedActions::ConstIterator ReportedActions::begin() const noexcept
{
    return _held.begin();
}

ReportedActions::ConstIterator ReportedActions::end() const noexcept
{
    return _held.end();
}

} // namespace ACS::VDA5050

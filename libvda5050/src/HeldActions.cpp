#include "OrderErrors.hpp"
#include "StateRoom.hpp"
#include <acs/vda5050/HeldActions.hpp>

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace ACS::VDA5050
{

bool HeldAction::IsInstant() const noexcept
{
    return scope == EActionScope::Instant;
}

bool HeldAction::IsEnded() const noexcept
{
    return IsTerminal(machine.GetStatus());
}

bool HeldAction::IsRunningInOrder() const noexcept
{
    return !IsInstant() && bStarted && !IsEnded();
}

HeldActions::Counts HeldActions::Measure(const HeldAction& held)
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

void HeldActions::Count(const HeldAction& held)
{
    std::ranges::transform(_counts, Measure(held), _counts.begin(), std::plus<>());
}

void HeldActions::Discount(const HeldAction& held)
{
    std::ranges::transform(_counts, Measure(held), _counts.begin(), std::minus<>());
}

std::size_t HeldActions::Get(ECount count) const noexcept
{
    return _counts[static_cast<std::size_t>(count)];
}

HeldAction& HeldActions::Add(HeldAction held)
{
    const Iterator position = _held.insert(_held.end(), std::move(held));
    const bool bNew = _index.emplace(position->action.actionID, position).second;
    assert(bNew);
    static_cast<void>(bNew);
    Count(*position);
    return *position;
}

HeldAction* HeldActions::FindOrNull(std::string_view actionID)
{
    const auto found = _index.find(actionID);
    return found == _index.end() ? nullptr : &*found->second;
}

bool HeldActions::TrySetStatus(HeldAction& held, EActionStatus status, std::string resultDescription)
{
    resultDescription.resize(CutForeignText(resultDescription).size());
    Discount(held);
    const bool bSet = held.machine.TrySet(status, std::move(resultDescription));
    Count(held);
    return bSet;
}

void HeldActions::MarkStarted(HeldAction& held)
{
    Discount(held);
    held.bStarted = true;
    Count(held);
}

HeldActions::Iterator HeldActions::Erase(Iterator position)
{
    Discount(*position);
    _index.erase(position->action.actionID);
    return _held.erase(position);
}

std::size_t HeldActions::GetSize() const noexcept
{
    return _held.size();
}

std::size_t HeldActions::CountInstant() const noexcept
{
    return Get(ECount::Instant);
}

std::size_t HeldActions::GetInstantBytes() const noexcept
{
    return Get(ECount::InstantBytes);
}

std::size_t HeldActions::CountOpen() const noexcept
{
    return Get(ECount::Open);
}

std::size_t HeldActions::CountRunning() const noexcept
{
    return Get(ECount::Running);
}

std::size_t HeldActions::CountRunningBlocking() const noexcept
{
    return Get(ECount::RunningBlocking);
}

std::size_t HeldActions::CountRunningHard() const noexcept
{
    return Get(ECount::RunningHard);
}

HeldActions::Iterator HeldActions::begin() noexcept
{
    return _held.begin();
}

HeldActions::Iterator HeldActions::end() noexcept
{
    return _held.end();
}

HeldActions::ConstIterator HeldActions::begin() const noexcept
{
    return _held.begin();
}

HeldActions::ConstIterator HeldActions::end() const noexcept
{
    return _held.end();
}

} // namespace ACS::VDA5050

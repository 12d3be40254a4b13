#include "OrderErrors.hpp"
#include "StateRoom.hpp"
#include <acs/vda5050/HeldActions.hpp>

#include <cassert>
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

void HeldActions::Count(const HeldAction& held)
{
    _instant += held.IsInstant() ? 1U : 0U;
    _instantBytes += held.IsInstant() ? MeasureActionState(held.machine.GetState()) : 0;
    _open += !held.IsInstant() && !held.IsEnded() ? 1U : 0U;
    if (held.IsRunningInOrder())
    {
        _running += 1;
        _runningBlocking += held.action.blockingType != EBlockingType::None ? 1U : 0U;
        _runningHard += held.action.blockingType == EBlockingType::Hard ? 1U : 0U;
    }
}

void HeldActions::Discount(const HeldAction& held)
{
    _instant -= held.IsInstant() ? 1U : 0U;
    _instantBytes -= held.IsInstant() ? MeasureActionState(held.machine.GetState()) : 0;
    _open -= !held.IsInstant() && !held.IsEnded() ? 1U : 0U;
    if (held.IsRunningInOrder())
    {
        _running -= 1;
        _runningBlocking -= held.action.blockingType != EBlockingType::None ? 1U : 0U;
        _runningHard -= held.action.blockingType == EBlockingType::Hard ? 1U : 0U;
    }
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
    return _instant;
}

std::size_t HeldActions::GetInstantBytes() const noexcept
{
    return _instantBytes;
}

std::size_t HeldActions::CountOpen() const noexcept
{
    return _open;
}

std::size_t HeldActions::CountRunning() const noexcept
{
    return _running;
}

std::size_t HeldActions::CountRunningBlocking() const noexcept
{
    return _runningBlocking;
}

std::size_t HeldActions::CountRunningHard() const noexcept
{
    return _runningHard;
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

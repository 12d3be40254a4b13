#include "vda-sim/FaultSchedule.hpp"

#include <utility>

namespace ACS::VdaSim
{

bool FaultSchedule::TryAdd(const Fault& fault, Core::SteadyTime now)
{
    if (_board.CountFaults() + _waiting.size() >= FaultBoard::MAX_FAULTS)
    {
        return false;
    }
    if (_bWasOnline)
    {
        _board.Add(fault, now, _changes);
    }
    else
    {
        _waiting.push_back(fault);
    }
    return true;
}

std::size_t FaultSchedule::End(std::optional<EFaultKind> kindOrNull, std::string_view reason)
{
    const std::size_t waiting = std::erase_if(_waiting, [kindOrNull](const Fault& fault) {
        return !kindOrNull.has_value() || fault.kind == *kindOrNull;
    });
    return waiting + _board.End(kindOrNull, reason, _changes);
}

void FaultSchedule::Use(const Fault& fault)
{
    _board.Use(fault, _changes);
}

void FaultSchedule::OnLinkUp(Core::SteadyTime now)
{
    _bWasOnline = true;
    for (Fault& fault : std::exchange(_waiting, {}))
    {
        _board.Add(std::move(fault), now, _changes);
    }
}

void FaultSchedule::OnTime(Core::SteadyTime now)
{
    _board.OnTime(now, _changes);
}

void FaultSchedule::OnPlace(std::string_view nodeID, Core::SteadyTime now)
{
    _board.OnPlace(nodeID, now, _changes);
}

FaultChanges FaultSchedule::TakeChanges()
{
    return std::exchange(_changes, {});
}

bool FaultSchedule::WasOnline() const noexcept
{
    return _bWasOnline;
}

const FaultBoard& FaultSchedule::GetBoard() const noexcept
{
    return _board;
}

} // namespace ACS::VdaSim

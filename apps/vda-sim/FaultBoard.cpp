#include "vda-sim/FaultBoard.hpp"

#include <cassert>
#include <utility>

namespace ACS::VdaSim
{

std::size_t FaultBoard::CountFaults() const noexcept
{
    return _entries.size();
}

void FaultBoard::Add(Fault fault, Core::SteadyTime now, FaultChanges& out)
{
    assert(_entries.size() < MAX_FAULTS);
    Entry& entry = _entries.emplace_back();
    entry.fault = std::move(fault);
    entry.bWaitsForNode = !entry.fault.nodeID.empty();
    if (entry.bWaitsForNode)
    {
        return;
    }
    entry.due = now + entry.fault.delay;
    // The others have their time; looking at all of them for each would take its square.
    if (*entry.due <= now)
    {
        Begin(entry, now, out);
        if (TryEnd(entry, now, out))
        {
            _entries.pop_back();
        }
    }
}

bool FaultBoard::TryEnd(const Entry& entry, Core::SteadyTime now, FaultChanges& out)
{
    const bool bOver = entry.bActive && entry.due.has_value() && *entry.due <= now;
    if (bOver)
    {
        out.push_back({entry.fault, false, "its time is over"});
    }
    // What is set once is over as soon as it has begun.
    return bOver || (entry.bActive && entry.fault.kind == EFaultKind::Battery);
}

void FaultBoard::Begin(Entry& entry, Core::SteadyTime now, FaultChanges& out)
{
    entry.bActive = true;
    entry.due = entry.fault.lasts.has_value() ? std::optional(now + *entry.fault.lasts) : std::nullopt;
    out.push_back({entry.fault, true, {}});
}

std::size_t FaultBoard::End(std::optional<EFaultKind> kindOrNull, std::string_view reason, FaultChanges& out)
{
    return std::erase_if(_entries, [&](const Entry& entry) {
        const bool bEnds = !kindOrNull.has_value() || entry.fault.kind == *kindOrNull;
        if (bEnds && entry.bActive)
        {
            out.push_back({entry.fault, false, reason});
        }
        return bEnds;
    });
}

void FaultBoard::OnNode(std::string_view nodeID, Core::SteadyTime now, FaultChanges& out)
{
    for (Entry& entry : _entries)
    {
        if (entry.bWaitsForNode && entry.fault.nodeID == nodeID)
        {
            entry.bWaitsForNode = false;
            entry.due = now + entry.fault.delay;
        }
    }
    OnTime(now, out);
}

void FaultBoard::OnTime(Core::SteadyTime now, FaultChanges& out)
{
    for (Entry& entry : _entries)
    {
        if (!entry.bActive && entry.due.has_value() && *entry.due <= now)
        {
            Begin(entry, *entry.due, out);
        }
    }
    std::erase_if(_entries, [&](const Entry& entry) { return TryEnd(entry, now, out); });
}

std::optional<Core::SteadyTime> FaultBoard::GetNextTimeOrNull() const
{
    std::optional<Core::SteadyTime> next;
    for (const Entry& entry : _entries)
    {
        if (entry.due.has_value() && (!next.has_value() || *entry.due < *next))
        {
            next = entry.due;
        }
    }
    return next;
}

const Fault* FaultBoard::FindOrNull(EFaultKind kind) const
{
    return FindOrNull(kind, [](const Fault&) { return true; });
}

void FaultBoard::Use(const Fault& fault, FaultChanges& out)
{
    const auto found = std::ranges::find(_entries, &fault, [](const Entry& entry) { return &entry.fault; });
    assert(found != _entries.end());
    ++found->uses;
    // Without a number and without an end it is meant for the next one alone.
    const std::uint32_t whileItLasts = found->fault.lasts.has_value() ? UINT32_MAX : 1;
    if (found->uses >= found->fault.maxUses.value_or(whileItLasts))
    {
        out.push_back({std::move(found->fault), false, "it is used up"});
        _entries.erase(found);
    }
}

bool FaultBoard::IsActive(EFaultKind kind) const
{
    return FindOrNull(kind) != nullptr;
}

bool FaultBoard::IsEmpty() const noexcept
{
    return _entries.empty();
}

} // namespace ACS::VdaSim

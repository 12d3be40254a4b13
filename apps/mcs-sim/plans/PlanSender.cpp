#include "plans/PlanSender.hpp"

#include "plans/RobotNaming.hpp"

#include <iterator>
#include <utility>

namespace ACS::McsSim
{

PlanSender::PlanSender(
    PlanTracker& tracker,
    const RobotBoard& board,
    FloorChecker* floorOrNull,
    EProfile profile,
    bool bFreshPlans,
    TrySendPlan trySend)
    : _tracker(tracker),
      _board(board),
      _profile(profile),
      _floorOrNull(floorOrNull),
      _trySend(std::move(trySend))
{
    for (std::size_t i = 0; bFreshPlans && i < tracker.GetPlans().size(); ++i)
    {
        _freshPlans.insert(i);
    }
}

std::size_t PlanSender::Add(PlannedPlan planned, bool bFresh)
{
    const std::size_t index = _tracker.AddPlan(std::move(planned));
    if (bFresh)
    {
        _freshPlans.insert(index);
    }
    if (_floorOrNull != nullptr)
    {
        _floorOrNull->OnPlansAdded();
    }
    return index;
}

bool PlanSender::TrySendOrHold(
    const PlannedPlan& planned,
    bool bFresh,
    bool bPlansTaken,
    Core::Now now,
    PlanTracker::Lines& lines)
{
    const std::size_t index = Add(planned, bFresh);
    if (bPlansTaken && !IsBlocked(index) && IsNamed(index))
    {
        return TrySend(index, now, lines);
    }
    _heldPlans.push_back(index);
    return true;
}

void PlanSender::SendHeld(bool bPlansTaken, Core::Now now, PlanTracker::Lines& lines)
{
    for (auto held = _heldPlans.begin(); bPlansTaken && held != _heldPlans.end();)
    {
        const bool bWaits = IsBlocked(*held) || !IsNamed(*held);
        if (!bWaits && !TrySend(*held, now, lines))
        {
            return;
        }
        held = bWaits ? std::next(held) : _heldPlans.erase(held);
    }
}

void PlanSender::SendDue(Core::Now now, PlanTracker::Lines& lines)
{
    std::size_t first = 0;
    std::optional<std::size_t> next = _tracker.GetNextToSendOrNull(now, first);
    while (next.has_value())
    {
        if (!IsNamed(*next))
        {
            first = *next + 1;
        }
        else if (!TrySend(*next, now, lines))
        {
            return;
        }
        next = _tracker.GetNextToSendOrNull(now, first);
    }
}

std::optional<Core::SteadyTime> PlanSender::GetFirstSentOrNull() const noexcept
{
    return _firstSent;
}

bool PlanSender::TrySend(std::size_t index, Core::Now now, PlanTracker::Lines& lines)
{
    if (_floorOrNull != nullptr && _tracker.GetPlans()[index].sends == 0)
    {
        _floorOrNull->OnSending(index, lines);
    }
    const PlannedPlan& planned = _tracker.GetPlans()[index].planned;
    if (!_trySend(planned.plan, planned.transactionID))
    {
        return false;
    }
    _firstSent = _firstSent.value_or(now.steady);
    _tracker.OnSent(index, now, lines);
    return true;
}

bool PlanSender::IsBlocked(std::size_t index) const
{
    return _tracker.GetPlans()[index].delivery == EDelivery::Blocked;
}

bool PlanSender::IsNamed(std::size_t index)
{
    const TrackedPlan& tracked = _tracker.GetPlans()[index];
    if (_profile != EProfile::Nexus || !_freshPlans.contains(index) || !NeedsRobot(tracked.planned.plan))
    {
        return true;
    }
    const std::optional<std::string> robotID = ChooseRobotOrNull(tracked.planned.plan, _board, index);
    if (robotID.has_value())
    {
        Protocol::ExecutionPlan named = tracked.planned.plan;
        NameRobot(named, *robotID);
        _tracker.ReplacePlan(index, named);
    }
    return robotID.has_value();
}

} // namespace ACS::McsSim

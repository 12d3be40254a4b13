#include "operator/StateFeed.hpp"

#include "view/PlanViewMaker.hpp"
#include "view/ViewCodec.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

StateFeed::StateFeed(Dependencies dependencies)
    : _dependencies(std::move(dependencies)),
      _maker(_dependencies.engine, _dependencies.clock.GetNow().wall),
      _entries([this](const ChangeEntry& entry, Core::Now now) { OnEntry(entry, now); }),
      _timer(_dependencies.executor, [this](int) { OnTimer(); })
{
}

void StateFeed::Start()
{
    OnTimer();
}

void StateFeed::Stop()
{
    _timer.CancelAll();
}

const StateView& StateFeed::Read()
{
    _read = _maker.Make(_dependencies.getProgram(), _dependencies.clock.GetNow().wall);
    return _read;
}

const StateView& StateFeed::Update()
{
    StateView fresh = _maker.Make(_dependencies.getProgram(), _dependencies.clock.GetNow().wall);
    const StateChanges changes = FindChanges(_state, fresh);
    _state = std::move(fresh);
    const std::vector<PlanView> ended = TakeEnded(changes);
    if (!changes.IsEmpty() || !ended.empty())
    {
        _dependencies.events.Publish("changes", EncodeChanges(changes, ended));
    }
    return _state;
}

Planning::IPlanObserver& StateFeed::GetObserver() noexcept
{
    return _entries;
}

std::uint64_t StateFeed::GetEventID() const noexcept
{
    return _dependencies.events.GetLastID();
}

void StateFeed::OnEntry(const ChangeEntry& entry, Core::Now now)
{
    _dependencies.events.Publish("entry", EncodeEntry(entry, now.wall));
    if (entry.endedPlanOrNull != nullptr && _ended.size() < MAX_ENDED)
    {
        _ended.push_back(MakePlanView(*entry.endedPlanOrNull, EPlanDetail::Steps));
    }
}

/// Of each plan that is not unfinished again. One that has begun and ended between two updates is in neither of their states, and
/// the engine may keep no record of it.
std::vector<PlanView> StateFeed::TakeEnded(const StateChanges& changes)
{
    std::vector<PlanView> ended = std::exchange(_ended, {});
    for (const std::string& planID : changes.endedPlanIDs)
    {
        const bool bNoted = std::ranges::find(ended, planID, &PlanView::planID) != ended.end();
        if (const Planning::PlanRecord* recordOrNull = _dependencies.engine.GetPlanRecordOrNull(planID);
            !bNoted && recordOrNull != nullptr)
        {
            ended.push_back(MakePlanView(*recordOrNull, EPlanDetail::Steps));
        }
    }
    std::erase_if(ended, [this](const PlanView& plan) {
        return std::ranges::find(_state.plans, plan.planID, &PlanView::planID) != _state.plans.end();
    });
    return ended;
}

void StateFeed::OnTimer()
{
    const Core::SteadyTime begin = _dependencies.clock.GetNow().steady;
    static_cast<void>(Update());
    const Core::Duration took = _dependencies.clock.GetNow().steady - begin;
    _timer.Start(0, std::clamp<Core::Duration>(SHARE * took, INTERVAL, LONGEST_INTERVAL));
}

} // namespace ACS::Acsd

#include "operator/StateFeed.hpp"

#include "view/PlanViewMaker.hpp"
#include "view/ViewCodec.hpp"

#include <algorithm>
#include <optional>
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
    StateChanges changes = FindChanges(_state, fresh);
    _state = std::move(fresh);
    AddEnded(changes);
    if (!changes.IsEmpty())
    {
        Publish(changes);
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
    if (entry.bPlanEnded && _endedPlanIDs.size() < MAX_ENDED)
    {
        _endedPlanIDs.emplace_back(entry.planID);
    }
}

/// A plan that has begun and ended between two updates is in neither of their states.
void StateFeed::AddEnded(StateChanges& changes)
{
    for (std::string& planID : std::exchange(_endedPlanIDs, {}))
    {
        const bool bListed = std::ranges::find(changes.endedPlanIDs, planID) != changes.endedPlanIDs.end();
        const bool bBegunAgain = std::ranges::find(_state.plans, planID, &PlanView::planID) != _state.plans.end();
        if (!bListed && !bBegunAgain)
        {
            changes.endedPlanIDs.push_back(std::move(planID));
        }
    }
}

void StateFeed::Publish(const StateChanges& changes)
{
    std::vector<PlanView> ended;
    for (const std::string& planID : changes.endedPlanIDs)
    {
        const Planning::PlanRecord* recordOrNull = _dependencies.engine.GetPlanRecordOrNull(planID);
        const std::optional<Planning::PlanSummary> summary = _dependencies.engine.GetPlanOrNull(planID);
        if (recordOrNull != nullptr && summary.has_value())
        {
            ended.push_back(MakePlanView(*recordOrNull, *summary, EPlanDetail::Steps));
        }
    }
    _dependencies.events.Publish("changes", EncodeChanges(changes, ended));
}

void StateFeed::OnTimer()
{
    const Core::SteadyTime begin = _dependencies.clock.GetNow().steady;
    static_cast<void>(Update());
    const Core::Duration took = _dependencies.clock.GetNow().steady - begin;
    _timer.Start(0, std::clamp<Core::Duration>(SHARE * took, INTERVAL, LONGEST_INTERVAL));
}

} // namespace ACS::Acsd

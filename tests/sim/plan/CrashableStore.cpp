#include "CrashableStore.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <algorithm>

namespace ACS::Simulation
{

Core::Result<void> CrashableStore::Commit(const Planning::StoreBatch& batch)
{
    if (bFails)
    {
        return Core::Fail(Planning::EPlanningError::StoreFailed, "acsd.db", "room", "disk full");
    }
    for (const Planning::StoreChange& change : batch.changes)
    {
        if (const auto* addedOrNull = std::get_if<Planning::ReportAdded>(&change); addedOrNull != nullptr)
        {
            _reports.emplace(addedOrNull->entry.transactionID, addedOrNull->entry.sequence);
        }
    }
    return _durable.Append(batch);
}

Planning::StoredState CrashableStore::Load()
{
    return *_durable.Load();
}

std::optional<std::uint64_t> CrashableStore::GetSequenceOrNull(const std::string& transactionID) const
{
    const auto found = _reports.find(transactionID);
    return found == _reports.end() ? std::nullopt : std::optional(found->second);
}

const Planning::PlanRecord* CrashableStore::FindPlanOrNull(std::string_view planID) const
{
    const auto& plans = _durable.GetState().plans;
    const auto found = std::ranges::find_if(plans, [planID](const Planning::PlanRecord& record) {
        return record.plan.planID == planID;
    });
    return found == plans.end() ? nullptr : &*found;
}

const Planning::StoredState& CrashableStore::GetState() const noexcept
{
    return _durable.GetState();
}

} // namespace ACS::Simulation

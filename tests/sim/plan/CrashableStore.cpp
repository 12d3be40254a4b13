#include "CrashableStore.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <chrono>

namespace ACS::Simulation
{

namespace
{

tl::unexpected<Core::Error> MakeDiskFault()
{
    return Core::Fail(Planning::EPlanningError::StoreFailed, "acsd.db", "room", "disk full");
}

} // namespace

CrashableStore::CrashableStore(bool bEpochChecked)
    : _bEpochChecked(bEpochChecked)
{
}

Core::Result<Planning::LeaseState> CrashableStore::ReadLease() const
{
    if (bFails)
    {
        return MakeDiskFault();
    }
    return _lease;
}

Core::Result<std::optional<std::uint64_t>> CrashableStore::TryTakeOrNull(
    const Planning::LeaseState& seen,
    std::chrono::milliseconds duration)
{
    if (bFails)
    {
        return MakeDiskFault();
    }
    if (seen != _lease)
    {
        return std::nullopt;
    }
    _lease = {_lease.epoch + 1, 0, "acsd", "", duration, false};
    return _lease.epoch;
}

Core::Result<bool> CrashableStore::TryRenew(std::uint64_t epoch)
{
    if (bFails)
    {
        return MakeDiskFault();
    }
    if (epoch != _lease.epoch || _lease.bReleased)
    {
        return false;
    }
    ++_lease.renewal;
    return true;
}

Core::Result<void> CrashableStore::Release(std::uint64_t epoch)
{
    if (bFails)
    {
        return MakeDiskFault();
    }
    if (epoch == _lease.epoch)
    {
        _lease.bReleased = true;
    }
    return {};
}

Core::Result<void> CrashableStore::Commit(const Planning::StoreBatch& batch, std::uint64_t epoch)
{
    if (_bEpochChecked && epoch != _lease.epoch)
    {
        return Core::Fail(Planning::EPlanningError::StoreTaken, "acsd.db", "the present epoch", "a former one");
    }
    if (bFails)
    {
        return MakeDiskFault();
    }
    Recover(batch);
    return {};
}

void CrashableStore::Recover(const Planning::StoreBatch& batch)
{
    for (const Planning::StoreChange& change : batch.changes)
    {
        if (const auto* addedOrNull = std::get_if<Planning::ReportAdded>(&change); addedOrNull != nullptr)
        {
            _reports.emplace(addedOrNull->entry.transactionID, addedOrNull->entry.sequence);
        }
    }
    static_cast<void>(_durable.Append(batch)); // never fails
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

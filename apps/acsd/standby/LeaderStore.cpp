#include "standby/LeaderStore.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <chrono>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::chrono::milliseconds RETRY_DELAY{100};

} // namespace

LeaderStore::LeaderStore(std::unique_ptr<Planning::IPlanStore> store, LeaseGuard& guard)
    : _store(std::move(store)),
      _guard(guard)
{
}

Core::Result<Planning::StoredState> LeaderStore::Load()
{
    return _store->Load();
}

Core::Result<void> LeaderStore::Append(const Planning::StoreBatch& batch)
{
    for (int attempt = 1;; ++attempt)
    {
        Core::Result<void> stored = _store->Append(batch);
        if (stored.has_value() || stored.error().code == Planning::EPlanningError::StoreTaken)
        {
            return stored;
        }
        if (attempt == MOST_ATTEMPTS || !_guard.TryWait(RETRY_DELAY))
        {
            stored.error().code = make_error_code(Planning::EPlanningError::StoreTaken);
            return stored;
        }
    }
}

Core::Result<void> LeaderStore::Check()
{
    Core::Result<void> checked = _store->Check();
    return checked.has_value() || checked.error().code == Planning::EPlanningError::StoreTaken ? checked
                                                                                               : Core::Result<void>();
}

Planning::StoreLog LeaderStore::CheckLog()
{
    return _store->CheckLog();
}

} // namespace ACS::Acsd

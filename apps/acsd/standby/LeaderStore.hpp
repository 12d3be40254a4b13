#pragma once

#include "standby/LeaseGuard.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <memory>

namespace ACS::Acsd
{

/// A shared store as a leader uses it. While it fails, nothing is commanded that the successor would not know: a batch is tried
/// again until it is stored, the lease has ended, or MOST_ATTEMPTS have failed, which no lost connection explains.
class LeaderStore final : public Planning::IPlanStore
{
public:
    static constexpr int MOST_ATTEMPTS = 30;

private:
    std::unique_ptr<Planning::IPlanStore> _store;
    LeaseGuard& _guard;

public:
    /// The guard outlives the store.
    LeaderStore(std::unique_ptr<Planning::IPlanStore> store, LeaseGuard& guard);

    [[nodiscard]] Core::Result<Planning::StoredState> Load() override;

    /// Fails with EPlanningError::StoreTaken only.
    [[nodiscard]] Core::Result<void> Append(const Planning::StoreBatch& batch) override;

    /// Likewise: whether the store can be reached is known by the lease.
    [[nodiscard]] Core::Result<void> Check() override;

    [[nodiscard]] Planning::StoreLog CheckLog() override;
};

} // namespace ACS::Acsd

#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/ILease.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::Simulation
{

/// The disk of a run: its content survives every crash. A batch is written completely or not at all. It has a lease, so that
/// processes can share it.
class CrashableStore final
{
    Planning::MemoryPlanStore _durable;
    std::unordered_map<std::string, std::uint64_t> _reports; ///< All reports that were ever stored, by transactionId.
    Planning::LeaseState _lease;
    bool _bEpochChecked;

public:
    /// Called by its owner.
    bool bFails = false;

    /// bEpochChecked: not with the mutation that accepts every epoch.
    explicit CrashableStore(bool bEpochChecked);

    /// As those of ILease.
    [[nodiscard]] Core::Result<Planning::LeaseState> ReadLease() const;
    [[nodiscard]] Core::Result<std::optional<std::uint64_t>> TryTakeOrNull(
        const Planning::LeaseState& seen,
        std::chrono::milliseconds duration);
    [[nodiscard]] Core::Result<bool> TryRenew(std::uint64_t epoch);
    [[nodiscard]] Core::Result<void> Release(std::uint64_t epoch);

    /// Called when the batch is on the disk. Fails with StoreTaken for an epoch of a former leader.
    [[nodiscard]] Core::Result<void> Commit(const Planning::StoreBatch& batch, std::uint64_t epoch);
    /// The next start finds a batch whose commit failed with StoreOutcomeUnknown.
    void Recover(const Planning::StoreBatch& batch);
    [[nodiscard]] Planning::StoredState Load();

    /// The number with which the report was stored; nullopt: never stored.
    [[nodiscard]] std::optional<std::uint64_t> GetSequenceOrNull(const std::string& transactionID) const;
    [[nodiscard]] const Planning::PlanRecord* FindPlanOrNull(std::string_view planID) const;
    [[nodiscard]] const Planning::StoredState& GetState() const noexcept;
};

} // namespace ACS::Simulation

#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace ACS::Simulation
{

/// The disk of a run: its content survives every crash. A batch is written completely or not at all.
class CrashableStore final
{
    Planning::MemoryPlanStore _durable;
    std::unordered_map<std::string, std::uint64_t> _reports; ///< All reports that were ever stored, by transactionId.

public:
    /// Called by its owner.
    bool bFails = false;

    /// Called when the batch is on the disk.
    [[nodiscard]] Core::Result<void> Commit(const Planning::StoreBatch& batch);
    [[nodiscard]] Planning::StoredState Load();

    /// The number with which the report was stored; nullopt: never stored.
    [[nodiscard]] std::optional<std::uint64_t> GetSequenceOrNull(const std::string& transactionID) const;
    [[nodiscard]] const Planning::PlanRecord* FindPlanOrNull(std::string_view planID) const;
    [[nodiscard]] const Planning::StoredState& GetState() const noexcept;
};

} // namespace ACS::Simulation

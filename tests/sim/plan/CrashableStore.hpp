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

/// The disk of a world: what is in it survives every crash. A batch is in it whole or not at all.
class CrashableStore final
{
    Planning::MemoryPlanStore _durable;
    std::unordered_map<std::string, std::uint64_t> _reports; ///< Every report that was ever stored, by transactionId.

public:
    /// By its owner.
    bool bFails = false;

    /// The moment at which the batch is on the disk.
    [[nodiscard]] Core::Result<void> Commit(const Planning::StoreBatch& batch);
    [[nodiscard]] Planning::StoredState Load();

    /// The number under which the report was stored; nullopt where it never was.
    [[nodiscard]] std::optional<std::uint64_t> GetSequenceOrNull(const std::string& transactionID) const;
    [[nodiscard]] const Planning::PlanRecord* FindPlanOrNull(std::string_view planID) const;
    [[nodiscard]] const Planning::StoredState& GetState() const noexcept;
};

} // namespace ACS::Simulation

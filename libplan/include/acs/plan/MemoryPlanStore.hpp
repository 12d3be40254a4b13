#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <string>

namespace ACS::Planning
{

/// Stores in memory only: for tests, examples and engines whose state need not survive a restart. Never fails.
class ACS_API MemoryPlanStore final : public IPlanStore
{
    StoredState _state;

public:
    [[nodiscard]] Core::Result<StoredState> Load() override;
    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch) override;
    [[nodiscard]] Core::Result<void> Check() override;
    [[nodiscard]] StoreLog CheckLog() override;

    /// What the next Load returns as StoredState::holdReason, until the TSC is Auto.
    void SetHoldReason(std::string reason);

    /// What Load would return.
    [[nodiscard]] const StoredState& GetState() const noexcept;
};

} // namespace ACS::Planning

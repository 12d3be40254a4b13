#pragma once

#include "transaction/EngineState.hpp"
#include <acs/plan/PlanTransitions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Owns the TSC state (section 6.20), which decides whether plans are started, and completes a pause.
class TscControl
{
    const EngineOptions& _options;
    const PlanBook& _plans;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    const StartupBarrier& _startup;
    RestartHold& _hold;
    ETscState _tscState = ETscState::Auto;

public:
    explicit TscControl(EngineState& engine);

    /// Handles the operator's command.
    void SwitchTSC(const ControlTSC& command);
    /// Publishes the present state as a change from another one.
    void PublishTscState(ETscState from);
    /// Pausing becomes Paused once no plan is running and no robot moves or works.
    void FinishTscPause();
    /// Whether idle robots may drive. While the TSC is pausing they only clear the routes of running plans.
    [[nodiscard]] bool CanDriveHome() const;
    /// Restores the stored state. A paused TSC stays paused; running plans are completed, unless the restart holds them.
    void RestoreTSC(ETscState stored);
    /// The published state: Paused while the startup barrier holds work back (section 6.20).
    [[nodiscard]] ETscState GetTscState() const noexcept;
    /// Why the published state is Paused although no operator has paused the TSC since the start; otherwise empty.
    [[nodiscard]] std::string_view GetReason() const noexcept;
    /// The state apart from the startup barrier.
    [[nodiscard]] ETscState GetState() const noexcept;

private:
    void ChangeTSC(ETscState state);
    /// Ends the hold of the restart: robots that were to resume are commanded to.
    void ReleaseHold();
    [[nodiscard]] bool IsHeldByStartup() const noexcept;
};

} // namespace ACS::Planning

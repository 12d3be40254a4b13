#pragma once

#include "transaction/EngineState.hpp"
#include <acs/plan/PlanTransitions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Whether plans are begun: the state of the TSC (section 5.2), and how a pause is finished.
class TscControl
{
    const EngineOptions& _options;
    const PlanBook& _plans;
    const Fleet& _fleet;
    EngineTransaction& _transaction;
    const StartupBarrier& _startup;
    ETscState _tscState = ETscState::Auto;

public:
    explicit TscControl(EngineState& engine);

    void SwitchTSC(const ControlTSC& command);
    void PublishTscState(ETscState from);
    /// The TSC is paused once no plan runs and no robot moves or works.
    void FinishTscPause();
    /// While the TSC is pausing, only to make way for what still runs.
    [[nodiscard]] bool CanDriveHome() const;
    /// What was paused stays so: nothing is begun. What was being worked on goes on to its end.
    void RestoreTSC(ETscState stored);
    /// Section 5.2: Paused until the first consistency check is done.
    [[nodiscard]] ETscState GetTscState() const noexcept;
    /// Without regard to the startup barrier.
    [[nodiscard]] ETscState GetState() const noexcept;

private:
    void ChangeTSC(ETscState state);
};

} // namespace ACS::Planning

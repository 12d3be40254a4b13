#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Sends robots with a low battery to charge, and commands charging (ChargingPolicy decides).
class ChargingControl
{
    const EngineOptions& _options;
    const PlanAdmission& _admission;
    Fleet& _fleet;
    EngineTransaction& _transaction;

public:
    explicit ChargingControl(EngineState& engine);

    /// By the robot's new state.
    void UpdateBattery(Robot& robot);
    /// Robots without work that stand at their charging stations, low or not.
    void ChargeIdle();
    /// Before it leaves, or as it is full enough.
    void EndCharging(Robot& robot);
    void OnChargeRetry(Robot& robot);
    [[nodiscard]] std::optional<std::size_t> GetHomeOrNull(const Robot& robot) const;
    [[nodiscard]] std::optional<std::size_t> GetChargeNodeOrNull(const Robot& robot) const;

private:
    [[nodiscard]] Alarm MakeChargeAlarm(const Robot& robot) const;
    [[nodiscard]] bool IsChargeDue(const Robot& robot) const;
};

} // namespace ACS::Planning

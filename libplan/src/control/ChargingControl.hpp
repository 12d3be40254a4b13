#pragma once

#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Chooses the home of each robot by its battery, commands charging and raises ACS-1010. ChargingPolicy keeps the state.
class ChargingControl
{
    const EngineOptions& _options;
    const PlanAdmission& _admission;
    Fleet& _fleet;
    EngineTransaction& _transaction;

public:
    explicit ChargingControl(EngineState& engine);

    /// Handles the battery and the charging in the robot's new state.
    void UpdateBattery(Robot& robot);
    /// Commands charging to each idle robot at its charging station.
    void ChargeIdle();
    /// The robot leaves its charging station, or its battery is charged.
    void EndCharging(Robot& robot);
    /// The robot has not shown that it charges: the command is repeated, and a low battery raises the alarm.
    void OnChargeRetry(Robot& robot);
    /// Node of the configured home station.
    [[nodiscard]] std::optional<std::size_t> GetHomeOrNull(const Robot& robot) const;
    /// Node of the configured charging station.
    [[nodiscard]] std::optional<std::size_t> GetChargeNodeOrNull(const Robot& robot) const;

private:
    [[nodiscard]] static Alarm MakeChargeAlarm(const Robot& robot);
    [[nodiscard]] bool IsChargeDue(const Robot& robot) const;
    /// Whether it charges at its charging station and parks elsewhere. A low battery brings it there, or a plan that ended there.
    [[nodiscard]] bool IsRecharged(const Robot& robot) const;
};

} // namespace ACS::Planning

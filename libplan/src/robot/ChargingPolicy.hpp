#pragma once

#include <acs/plan/EngineOptions.hpp>

#include <cstdint>

namespace ACS::Planning
{

/// A robot's battery and whether the robot charges. A low battery stays low until it has reached the upper limit.
class ChargingPolicy
{
public:
    enum class EBatteryChange : std::uint8_t
    {
        None,
        Low,     ///< Below DispatchOptions::batteryFloor, or found being recharged: no more plans.
        Charged, ///< At DispatchOptions::batteryResume: plans again.
    };

    enum class EChargingChange : std::uint8_t
    {
        None,
        Begun,
        Interrupted, ///< By the robot itself: the charge command is repeated later.
    };

private:
    enum class EBattery : std::uint8_t
    {
        Unknown, ///< Since the start.
        Sufficient,
        Low,
    };

    enum class EState : std::uint8_t
    {
        Idle,
        Commanded, ///< The robot has not shown yet that it charges.
        Charging,
    };

    EBattery _battery = EBattery::Unknown;
    EState _state = EState::Idle;

public:
    /// The robot is recharged: it charges where only a robot with a low battery does. The first report after a start shows by that
    /// that the battery was low before.
    [[nodiscard]] EBatteryChange UpdateBattery(double percent, bool bRecharged, const DispatchOptions& limits);
    [[nodiscard]] EChargingChange UpdateCharging(bool bCharging);

    /// True: command the robot to charge. False: it has the command, or charges.
    [[nodiscard]] bool TryBegin();
    /// True: command the robot to stop charging.
    [[nodiscard]] bool TryEnd();
    /// True: the robot had the command and does not charge; it may be commanded again.
    [[nodiscard]] bool TryRepeat();
    void OnLinkLost();

    [[nodiscard]] bool IsBatteryLow() const noexcept;
    /// Charging was commanded or is shown.
    [[nodiscard]] bool IsCommanded() const noexcept;
};

} // namespace ACS::Planning

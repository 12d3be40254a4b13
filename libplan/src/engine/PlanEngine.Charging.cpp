#include "engine/PlanEngine.Impl.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Planning
{

Alarm PlanEngine::Impl::MakeChargeAlarm(const Robot& robot) const
{
    return MakeAlarm(
        GetRobotID(robot),
        ALARM_CHARGE,
        EAlarmLevel::Light,
        "It stands at its charging station with a low battery and does not charge.");
}

/// By the robot's new state.
void PlanEngine::Impl::UpdateBattery(Robot& robot)
{
    using EBatteryChange = ChargingPolicy::EBatteryChange;
    using EChargingChange = ChargingPolicy::EChargingChange;
    if (!robot.chargeNode.has_value())
    {
        return;
    }
    const DispatchOptions& dispatch = _options.dispatch;
    const EBatteryChange battery = robot.charging.UpdateBattery(robot.state->batteryPercent, dispatch);
    if (battery != EBatteryChange::None)
    {
        const bool bLow = battery == EBatteryChange::Low;
        Note(
            robot,
            fmt::format("its battery is {}", bLow ? "low: it takes no new plan" : "full enough for plans again"));
        robot.homeNode = bLow ? robot.chargeNode : GetHomeOrNull(robot);
        robot.plannedRoute.reset();
        _bDispatchNeeded = true;
        if (!bLow && robot.homeNode.has_value() && robot.homeNode != robot.chargeNode)
        {
            EndCharging(robot);
        }
    }
    const EChargingChange charging = robot.charging.UpdateCharging(robot.state->bCharging);
    if (charging == EChargingChange::Begun)
    {
        CancelTimer(EEngineTimer::ChargeRetry, GetRobotID(robot));
        ClearAlarm(MakeChargeAlarm(robot));
    }
    else if (charging == EChargingChange::Interrupted)
    {
        StartTimer(EEngineTimer::ChargeRetry, GetRobotID(robot), dispatch.chargeRetry);
    }
    _bDispatchNeeded = _bDispatchNeeded || (IsChargeDue(robot) && !robot.charging.IsCommanded());
}

std::optional<std::size_t> PlanEngine::Impl::GetHomeOrNull(const Robot& robot) const
{
    return robot.options->homeStationID.has_value()
        ? _admission.FindDockOrNull(*robot.options->homeStationID, robot.options->vehicleTypeID)
        : std::nullopt;
}

bool PlanEngine::Impl::IsChargeDue(const Robot& robot) const
{
    return robot.chargeNode.has_value() && robot.planOrNull == nullptr && !robot.drive.has_value() && IsUsable(robot)
        && robot.node == robot.chargeNode && robot.state->batteryPercent < _options.dispatch.batteryResume;
}

/// Robots without work that stand at their charging stations, low or not.
void PlanEngine::Impl::ChargeIdle()
{
    for (Robot& robot : _robots)
    {
        if (IsChargeDue(robot) && !robot.state->bCharging && robot.charging.TryBegin())
        {
            Command(robot, StartCharging{});
            StartTimer(EEngineTimer::ChargeRetry, GetRobotID(robot), _options.dispatch.chargeRetry);
        }
    }
}

void PlanEngine::Impl::OnChargeRetry(Robot& robot)
{
    if (!IsChargeDue(robot) || robot.state->bCharging || !robot.charging.TryRepeat())
    {
        return;
    }
    if (robot.charging.IsBatteryLow())
    {
        RaiseAlarm(MakeChargeAlarm(robot));
    }
    _bDispatchNeeded = true;
}

/// Before it leaves, or as it is full enough.
void PlanEngine::Impl::EndCharging(Robot& robot)
{
    if (!robot.chargeNode.has_value() || !robot.charging.TryEnd())
    {
        return;
    }
    CancelTimer(EEngineTimer::ChargeRetry, GetRobotID(robot));
    Command(robot, StopCharging{});
}

} // namespace ACS::Planning

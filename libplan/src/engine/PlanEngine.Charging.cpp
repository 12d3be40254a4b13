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

/// Its new state has told how full the battery is.
void PlanEngine::Impl::FollowBattery(Robot& robot)
{
    if (!robot.chargeNode.has_value())
    {
        return;
    }
    const DispatchOptions& dispatch = _options.dispatch;
    const bool bLow =
        robot.state->batteryPercent < (robot.bBatteryLow ? dispatch.batteryResume : dispatch.batteryFloor);
    if (bLow != std::exchange(robot.bBatteryLow, bLow))
    {
        Note(
            robot,
            fmt::format("its battery is {}", bLow ? "low: it takes no new plan" : "full enough for plans again"));
        robot.homeNode = bLow ? robot.chargeNode : GetHomeOrNull(robot);
        robot.wish.reset();
        _bDispatchNeeded = true;
        if (!bLow && robot.homeNode.has_value() && robot.homeNode != robot.chargeNode)
        {
            EndCharging(robot);
        }
    }
    if (robot.state->bCharging)
    {
        CancelTimer(EEngineTimer::ChargeRetry, GetRobotID(robot));
        robot.bChargeAsked = true;
        robot.bChargeShown = true;
        ClearAlarm(MakeChargeAlarm(robot));
    }
    else if (std::exchange(robot.bChargeShown, false) && robot.bChargeAsked)
    {
        // It has ended that by itself: asked again only after a while.
        StartTimer(EEngineTimer::ChargeRetry, GetRobotID(robot), dispatch.chargeRetry);
    }
    _bDispatchNeeded = _bDispatchNeeded || (IsChargeDue(robot) && !robot.bChargeAsked);
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
        if (IsChargeDue(robot) && !robot.state->bCharging && !robot.bChargeAsked)
        {
            robot.bChargeAsked = true;
            Command(robot, StartCharging{});
            StartTimer(EEngineTimer::ChargeRetry, GetRobotID(robot), _options.dispatch.chargeRetry);
        }
    }
}

void PlanEngine::Impl::OnChargeRetry(Robot& robot)
{
    if (!robot.bChargeAsked || !IsChargeDue(robot) || robot.state->bCharging)
    {
        return;
    }
    if (robot.bBatteryLow)
    {
        RaiseAlarm(MakeChargeAlarm(robot));
    }
    robot.bChargeAsked = false;
    _bDispatchNeeded = true;
}

/// Before it leaves, or as it is full enough.
void PlanEngine::Impl::EndCharging(Robot& robot)
{
    if (!robot.chargeNode.has_value() || !std::exchange(robot.bChargeAsked, false))
    {
        return;
    }
    robot.bChargeShown = false;
    CancelTimer(EEngineTimer::ChargeRetry, GetRobotID(robot));
    Command(robot, StopCharging{});
}

} // namespace ACS::Planning

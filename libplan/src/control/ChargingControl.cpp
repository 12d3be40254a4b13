#include "control/ChargingControl.hpp"

#include <fmt/format.h>

namespace ACS::Planning
{

ChargingControl::ChargingControl(EngineState& engine)
    : _options(engine.options),
      _admission(engine.admission),
      _fleet(engine.fleet),
      _transaction(engine.transaction)
{
}

void ChargingControl::UpdateBattery(Robot& robot)
{
    using EBatteryChange = ChargingPolicy::EBatteryChange;
    using EChargingChange = ChargingPolicy::EChargingChange;
    if (!robot.parking.chargeNode.has_value())
    {
        return;
    }
    const DispatchOptions& dispatch = _options.dispatch;
    // First: a robot that is full is then commanded once to end what its state still shows.
    const EChargingChange charging = robot.charging.UpdateCharging(robot.view.state->bCharging);
    if (charging == EChargingChange::Begun)
    {
        _transaction.CancelTimer(EEngineTimer::ChargeRetry, robot.GetID());
        _transaction.ClearAlarm(MakeChargeAlarm(robot));
    }
    else if (charging == EChargingChange::Interrupted)
    {
        _transaction.StartTimer(EEngineTimer::ChargeRetry, robot.GetID(), dispatch.chargeRetry);
    }
    const double percent = robot.view.state->batteryPercent;
    const EBatteryChange battery = robot.charging.UpdateBattery(percent, IsRecharged(robot), dispatch);
    if (!robot.charging.IsBatteryLow())
    {
        // It may have been charged by hand, or does not show that it charges.
        _transaction.ClearAlarm(MakeChargeAlarm(robot));
    }
    if (battery != EBatteryChange::None)
    {
        const bool bLow = battery == EBatteryChange::Low;
        const bool bFound = bLow && percent >= dispatch.batteryFloor;
        const std::string lowText = bFound
            ? fmt::format("found charging: no new plan is assigned up to {:.0f} %", dispatch.batteryResume)
            : fmt::format("battery below {:.0f} %: no new plan is assigned", dispatch.batteryFloor);
        _transaction.Note(
            robot,
            bLow ? lowText : fmt::format("battery at {:.0f} %: available for plans", dispatch.batteryResume));
        robot.parking.homeNode = bLow ? robot.parking.chargeNode : GetHomeOrNull(robot);
        robot.search.plannedRoute.reset();
        _transaction.RequestDispatch();
        if (!bLow && robot.parking.homeNode.has_value() && robot.parking.homeNode != robot.parking.chargeNode)
        {
            EndCharging(robot);
        }
    }
    if (IsChargeDue(robot) && !robot.charging.IsCommanded())
    {
        _transaction.RequestDispatch();
    }
}

void ChargingControl::ChargeIdle()
{
    for (Robot& robot : _fleet)
    {
        if (IsChargeDue(robot) && !robot.view.state->bCharging && robot.charging.TryBegin())
        {
            _transaction.Command(robot, StartCharging{});
            _transaction.StartTimer(EEngineTimer::ChargeRetry, robot.GetID(), _options.dispatch.chargeRetry);
        }
    }
}

void ChargingControl::EndCharging(Robot& robot)
{
    if (!robot.parking.chargeNode.has_value() || !robot.charging.TryEnd())
    {
        return;
    }
    _transaction.CancelTimer(EEngineTimer::ChargeRetry, robot.GetID());
    _transaction.Command(robot, StopCharging{});
}

void ChargingControl::OnChargeRetry(Robot& robot)
{
    const bool bCharging = robot.view.state.has_value() && robot.view.state->bCharging;
    if (bCharging || !robot.charging.TryRepeat() || !IsChargeDue(robot))
    {
        return; // If it is not due now, ChargeIdle repeats the command once it is.
    }
    if (robot.charging.IsBatteryLow())
    {
        _transaction.RaiseAlarm(MakeChargeAlarm(robot));
    }
    _transaction.RequestDispatch();
}

Alarm ChargingControl::MakeChargeAlarm(const Robot& robot)
{
    return MakeAlarm(
        robot.GetID(),
        ALARM_CHARGE,
        EAlarmLevel::Light,
        "Robot not charging: its battery is low and it is at its charging station. Check the charger and its contact.");
}

bool ChargingControl::IsChargeDue(const Robot& robot) const
{
    return robot.parking.chargeNode.has_value() && robot.planOrNull == nullptr && !robot.drive.has_value()
        && robot.IsUsable() && !robot.IsStopping() && robot.place.IsOn(robot.parking.chargeNode)
        && robot.view.state->batteryPercent < _options.dispatch.batteryResume;
}

bool ChargingControl::IsRecharged(const Robot& robot) const
{
    const std::optional<std::size_t> home = GetHomeOrNull(robot);
    return home.has_value() && home != robot.parking.chargeNode && robot.view.state->bCharging
        && robot.place.IsOn(robot.parking.chargeNode);
}

std::optional<std::size_t> ChargingControl::GetHomeOrNull(const Robot& robot) const
{
    return robot.options->homeStationID.has_value()
        ? _admission.FindDockOrNull(*robot.options->homeStationID, robot.options->vehicleTypeID)
        : std::nullopt;
}

std::optional<std::size_t> ChargingControl::GetChargeNodeOrNull(const Robot& robot) const
{
    return robot.options->chargingStationID.has_value()
        ? _admission.FindDockOrNull(*robot.options->chargingStationID, robot.options->vehicleTypeID)
        : std::nullopt;
}

} // namespace ACS::Planning

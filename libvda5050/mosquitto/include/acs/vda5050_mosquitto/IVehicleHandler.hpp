#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/VehicleAction.hpp>

#include <system_error>

namespace ACS::VDA5050
{

/// Receives what a VehicleClient requests and reports: on the executor, never during a call of the application. May call and
/// destroy the client.
class ACS_API IVehicleHandler
{
public:
    IVehicleHandler() = default;
    IVehicleHandler(const IVehicleHandler&) = delete;
    IVehicleHandler& operator=(const IVehicleHandler&) = delete;
    virtual ~IVehicleHandler() = default;

    /// Connected to the broker, and all subscriptions are confirmed.
    virtual void OnBrokerUp() = 0;
    /// The connection to the broker was lost, and is tried again. The vehicle drives on to the end of its base.
    virtual void OnBrokerDown(std::error_code reason) = 0;
    /// What the vehicle must do, or what has become of an order: any VehicleAction except PublishMessage and those of timers.
    virtual void OnVehicleAction(const VehicleAction& action) = 0;
};

} // namespace ACS::VDA5050

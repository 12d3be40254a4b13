#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/MasterAction.hpp>

#include <cstddef>
#include <system_error>

namespace ACS::VDA5050
{

/// Receives what a MasterClient reports: on the executor, never during a call of the application. May call and destroy the client.
class ACS_API IMasterHandler
{
public:
    IMasterHandler() = default;
    IMasterHandler(const IMasterHandler&) = delete;
    IMasterHandler& operator=(const IMasterHandler&) = delete;
    virtual ~IMasterHandler() = default;

    /// Connected to the broker, and all subscriptions are confirmed.
    virtual void OnBrokerUp() = 0;
    /// The connection to the broker was lost, and is tried again.
    virtual void OnBrokerDown(std::error_code reason) = 0;
    /// An event of a vehicle: any MasterAction except the first three. The first one of a vehicle has a new number. The session
    /// may be ahead of the event.
    virtual void OnVehicleEvent(std::size_t vehicle, const MasterAction& event) = 0;
};

} // namespace ACS::VDA5050

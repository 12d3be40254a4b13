#pragma once

#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050/Topic.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::VDA5050
{

/// Address, times and behaviour of a MasterSession.
struct MasterOptions
{
    VehicleAddress address;                                ///< Of the vehicle; must be valid (IsValidAddress).
    EVda5050Version version = EVda5050Version::Version200; ///< Of sent messages; both versions are read.
    QosTable qos;                                          ///< Of published messages and subscriptions.

    /// Interval of resends of an order or instant action until the vehicle shows it.
    std::chrono::milliseconds resendInterval{2'000};
    /// Resends of a message before it counts as rejected; 0: no limit (a silent vehicle is reported in any case).
    std::uint32_t resendCount = 0;
    /// Maximum interval of states (30 s in the standard); VehicleSilent after this and the margin.
    std::chrono::milliseconds stateInterval{30'000};
    /// Additional time for a late state.
    std::chrono::milliseconds stateMargin{5'000};
    /// Request the factsheet each time the vehicle comes online: it may have changed.
    bool bFactsheetRequested = true;
    /// In effect until the vehicle has sent its own.
    std::optional<FactsheetMessage> factsheet = std::nullopt;
    /// Send only what the factsheet supports: see MasterSession::SendOrder.
    bool bFactsheetObeyed = true;
    /// zoneSetId of orders that have none; may be empty.
    std::string zoneSetID = {};
    /// Request a state when the vehicle comes online: the broker retains ONLINE, but no state.
    bool bStateRequested = true;
    /// Prefix of the ids of the session's own actions (cancelOrder, stateRequest, …), which the wall clock and a counter make
    /// unique. Each master of a vehicle needs its own prefix.
    std::string actionIDPrefix = "acs";
};

} // namespace ACS::VDA5050

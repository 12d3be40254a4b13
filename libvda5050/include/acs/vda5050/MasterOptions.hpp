#pragma once

#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050/Topic.hpp>

#include <chrono>
#include <cstdint>
#include <string>

namespace ACS::VDA5050
{

struct MasterOptions
{
    VehicleAddress address;
    EVda5050Version version = EVda5050Version::Version200; ///< What is written; either is read.
    QosTable qos;

    /// An order or instant action is sent again this often until the vehicle shows it.
    std::chrono::milliseconds resendInterval{2'000};
    /// Resends of one message before it counts as rejected; 0: for ever, a vehicle that is silent is told of anyway.
    std::uint32_t resendCount = 0;
    /// A state is due at the latest after this (the standard's 30 s) and the margin.
    std::chrono::milliseconds stateInterval{30'000};
    std::chrono::milliseconds stateMargin{5'000};
    /// Ask for the factsheet at online unless the retained one has come.
    bool bFactsheetRequested = true;
    /// Send only what the factsheet supports, once it has come: see MasterSession::SendOrder.
    bool bFactsheetObeyed = true;
    /// Ask for a state at online: the retained ONLINE may be the only thing that the broker still has.
    bool bStateRequested = true;
    /// Prefix of the ids of the session's own actions (cancelOrder, stateRequest, …). They are made unique by the wall
    /// clock and a counter; give each master of one vehicle another prefix.
    std::string actionIDPrefix = "acs";
};

} // namespace ACS::VDA5050

#pragma once

#include <acs/vda5050/EParameterCheck.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050/Topic.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// Address, capabilities and behaviour of a VehicleSession.
struct VehicleOptions
{
    VehicleAddress address;                                ///< Of this vehicle; must be valid (IsValidAddress).
    EVda5050Version version = EVda5050Version::Version200; ///< Of sent messages; both versions are read.
    QosTable qos;                                          ///< Of published messages and subscriptions.
    /// Capabilities of the vehicle; the session sets header and timing. Orders are checked against it: an action, a
    /// parameter, an optional member or a size that it does not list is refused. An empty list of actions allows all.
    /// Without a list of optional parameters all are supported, and listed in what is published.
    FactsheetMessage factsheet;
    EParameterCheck parameterCheck = EParameterCheck::Tolerant; ///< Of parameters that the factsheet does not list.

    /// Minimum interval of states, without exception: changes within it are merged into the next one.
    std::chrono::milliseconds minimumStateInterval{50};
    /// Maximum interval of states.
    std::chrono::milliseconds maximumStateInterval{30'000};
    /// Interval of visualization messages; 0 disables them.
    std::chrono::milliseconds visualizationInterval{0};
    /// newBaseRequest if at most this number of released nodes is left and there is a horizon.
    std::size_t lowBaseNodes = 1;
    /// Maximum distance in metres from the first node of an order that states no deviation, or 0.
    double defaultDeviationXY = 0.5;
    /// If one of these fails, the order stops with a FATAL error until master control cancels it.
    std::vector<std::string> criticalActionTypes;
    /// Whether a cancel stops the vehicle between two nodes; otherwise it drives to the next one (line guided).
    bool bStopsBetweenNodes = true;
    /// Whether the vehicle forgets everything at a change to MANUAL: the state then has no orderId, no actions that have
    /// ended or belong to the order, and between two nodes no lastNodeId. Otherwise the cleared order stays in the state.
    bool bForgetsInManual = false;
    /// Additional check of an otherwise valid order or update; not called for a resent one.
    OrderCheck orderCheck;
    /// Maps of the vehicle in addition to those of OnMaps. Orders with other maps are refused, unless both are empty.
    std::vector<std::string> mapIDs;
    /// Zone sets of the vehicle. Orders with another one are refused, unless empty.
    std::vector<std::string> zoneSetIDs;
    /// Node of the vehicle at start; empty: not on a node.
    std::string initialNodeID;
};

} // namespace ACS::VDA5050

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

struct VehicleOptions
{
    VehicleAddress address;
    EVda5050Version version = EVda5050Version::Version200;
    QosTable qos;
    /// What the vehicle can do; header and timing are filled in by the session. An order is held against it: an action,
    /// a parameter, an optional member or a size that it does not list is refused. Lists that are empty refuse nothing.
    FactsheetMessage factsheet;
    EParameterCheck parameterCheck = EParameterCheck::Tolerant;

    /// Changes closer together than this go into one state.
    std::chrono::milliseconds minimumStateInterval{50};
    /// A state at the latest after this.
    std::chrono::milliseconds maximumStateInterval{30'000};
    /// 0: no visualization.
    std::chrono::milliseconds visualizationInterval{0};
    /// newBaseRequest once no more than this many released nodes are left and there is a horizon.
    std::size_t lowBaseNodes = 1;
    /// Metres: how far from its first node a vehicle may stand where the order states no deviation, or 0.
    double defaultDeviationXY = 0.5;
    /// An order does not go on after one of these has failed: the error is FATAL, and master control has to cancel it.
    std::vector<std::string> criticalActionTypes;
    /// Whether a cancel stops the vehicle between two nodes; else it drives to the next one (line guided).
    bool bStopsBetweenNodes = true;
    /// Asked before an order or update is taken that is right in all else; not for a resent one.
    OrderCheck orderCheck;
    /// Maps that the vehicle has beside those of OnMaps. Orders with other maps are refused; where both are empty, none.
    std::vector<std::string> mapIDs;
    /// Zone sets that the vehicle has. Orders for another one are refused; where empty, none.
    std::vector<std::string> zoneSetIDs;
    /// Where the vehicle stands at first; empty: not on a node.
    std::string initialNodeID;
};

} // namespace ACS::VDA5050

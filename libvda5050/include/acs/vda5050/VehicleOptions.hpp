#pragma once

#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
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
    /// What the vehicle can do; its header is filled in by the session. Without any agvActions every action is taken.
    FactsheetMessage factsheet;

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
    /// Whether a cancel stops the vehicle between two nodes; else it drives to the next one (line guided).
    bool bStopsBetweenNodes = true;
    /// Orders with other maps are refused; empty: every map is known.
    std::vector<std::string> mapIDs;
    /// Where the vehicle stands at first; empty: not on a node.
    std::string initialNodeID;
};

} // namespace ACS::VDA5050

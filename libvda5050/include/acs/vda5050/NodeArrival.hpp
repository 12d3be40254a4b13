#pragma once

#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// How an action of the edge ended at the edge's end node.
struct EdgeActionEnd
{
    std::string actionID;
    EActionStatus status = EActionStatus::Finished; ///< Finished or Failed.
    std::string resultDescription = {};
};

/// The arrival at the node of the last DriveTo: node, standstill and the end of the edge's actions are one event, which one
/// state shows.
struct NodeArrival
{
    std::uint32_t sequenceID = 0;
    /// The vehicle is stationary: required on a leg with bStopAtNode, and instead of OnDrivingChanged(false).
    bool bStationary = false;
    /// The results of the actions of the edge that the vehicle has left. Running ones that are not listed fail, and the session
    /// requests StopAction.
    std::vector<EdgeActionEnd> edgeActions = {};
};

} // namespace ACS::VDA5050

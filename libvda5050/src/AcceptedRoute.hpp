#pragma once

#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

/// The route of an order, base and horizon, as far as the vehicle has accepted it, and the number of nodes it has reached.
class AcceptedRoute
{
    struct RouteNode
    {
        std::string nodeID;
        std::uint32_t sequenceID = 0;
        bool bReleased = false;
        std::vector<std::string> actionIDs; ///< Of the node and of the edge to it.
    };

    std::vector<RouteNode> _nodes;
    std::size_t _reachedNodes = 0; ///< Number of nodes that were reported.

public:
    /// The message continues the route at its first node, and replaces what was planned after it.
    void Extend(const OrderMessage& order);
    void Clear();
    /// Reports the nodes up to the last one that the state shows as reached.
    void ReportReached(const StateMessage& state, MasterActions& out);

    [[nodiscard]] bool IsReached() const noexcept;
    /// Whether the node is the last one of the route, and released.
    [[nodiscard]] bool IsEnd(std::string_view nodeID, std::uint32_t sequenceID) const;
    /// The last released node, where an update begins.
    [[nodiscard]] std::pair<std::string, std::uint32_t> GetDecisionPoint() const;
    /// Valid until the route changes.
    [[nodiscard]] std::set<std::string_view> ListActionIDs() const;
};

} // namespace ACS::VDA5050

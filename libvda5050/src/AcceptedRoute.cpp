#include "AcceptedRoute.hpp"

#include <algorithm>
#include <iterator>

namespace ACS::VDA5050
{

void AcceptedRoute::Extend(const OrderMessage& order)
{
    const bool bFirst = _nodes.empty();
    const std::uint32_t stitch = order.nodes.front().sequenceID;
    std::erase_if(_nodes, [stitch](const RouteNode& node) { return node.sequenceID > stitch; });
    for (std::size_t index = bFirst ? 0 : 1; index < order.nodes.size(); ++index)
    {
        const OrderNode& node = order.nodes[index];
        RouteNode& entry = _nodes.emplace_back(RouteNode{node.nodeID, node.sequenceID, node.bReleased, {}});
        std::ranges::transform(node.actions, std::back_inserter(entry.actionIDs), &Action::actionID);
        if (index > 0)
        {
            std::ranges::transform(
                order.edges[index - 1].actions,
                std::back_inserter(entry.actionIDs),
                &Action::actionID);
        }
    }
}

void AcceptedRoute::Clear()
{
    _nodes.clear();
    _reachedNodes = 0;
}

void AcceptedRoute::ReportReached(const StateMessage& state, MasterActions& out)
{
    const auto isReached = [&state](const RouteNode& node) {
        return node.bReleased && node.sequenceID == state.lastNodeSequenceID && node.nodeID == state.lastNodeID
            && std::ranges::find(state.nodeStates, node.sequenceID, &NodeState::sequenceID) == state.nodeStates.end();
    };
    const auto begin = _nodes.begin() + static_cast<std::ptrdiff_t>(_reachedNodes);
    const auto last = std::find_if(begin, _nodes.end(), isReached);
    if (last == _nodes.end())
    {
        return;
    }
    for (auto node = begin; node != std::next(last); ++node)
    {
        out.emplace_back(NodeReached{node->nodeID, node->sequenceID});
    }
    _reachedNodes = static_cast<std::size_t>(std::distance(_nodes.begin(), last)) + 1;
}

bool AcceptedRoute::IsReached() const noexcept
{
    return _reachedNodes == _nodes.size();
}

bool AcceptedRoute::IsEnd(std::string_view nodeID, std::uint32_t sequenceID) const
{
    return !_nodes.empty() && _nodes.back().bReleased && _nodes.back().nodeID == nodeID
        && _nodes.back().sequenceID == sequenceID;
}

std::pair<std::string, std::uint32_t> AcceptedRoute::GetDecisionPoint() const
{
    std::pair<std::string, std::uint32_t> point;
    for (const RouteNode& node : _nodes)
    {
        point = node.bReleased ? std::pair(node.nodeID, node.sequenceID) : point;
    }
    return point;
}

std::set<std::string_view> AcceptedRoute::ListActionIDs() const
{
    std::set<std::string_view> actionIDs;
    for (const RouteNode& node : _nodes)
    {
        actionIDs.insert(node.actionIDs.begin(), node.actionIDs.end());
    }
    return actionIDs;
}

} // namespace ACS::VDA5050

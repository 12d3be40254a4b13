#include "ActionIndex.hpp"
#include "MasterSession.Impl.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace ACS::VDA5050
{

void MasterSession::Impl::TrackOrderActions(const OrderMessage& order)
{
    std::set<std::string_view> ofRoute;
    for (const RouteNode& node : _route)
    {
        ofRoute.insert(node.actionIDs.begin(), node.actionIDs.end());
    }
    const auto isDropped = [&ofRoute](const TrackedAction& tracked) {
        return !tracked.bInstant && !ofRoute.contains(tracked.actionID);
    };
    std::erase_if(_tracked, isDropped);
    std::set<std::string> known;
    for (const TrackedAction& tracked : _tracked)
    {
        known.insert(tracked.actionID);
    }
    const auto track = [this, &known](const std::vector<Action>& actions) {
        for (const Action& action : actions)
        {
            if (known.insert(action.actionID).second)
            {
                _tracked.push_back(TrackedAction{action.actionID, action.actionType, false, false});
            }
        }
    };
    // The node where an update begins has been tracked with the message before it.
    const std::size_t first = _bAccepted ? 1 : 0;
    for (std::size_t index = first; index < order.nodes.size(); ++index)
    {
        track(order.nodes[index].actions);
    }
    for (const OrderEdge& edge : order.edges)
    {
        track(edge.actions);
    }
}

void MasterSession::Impl::UpdateActions(const ActionIndex& shown, MasterActions& out)
{
    const auto isEnded = [&shown, &out](TrackedAction& tracked) {
        const ActionState* const state = shown.FindOrNull(tracked.actionID);
        if (state != nullptr)
        {
            tracked.bShown = true;
            return IsTerminal(state->actionStatus);
        }
        if (tracked.bShown)
        {
            out.emplace_back(ActionLost{tracked.actionID, tracked.actionType, "the vehicle no longer reports it"});
        }
        return tracked.bShown;
    };
    std::erase_if(_tracked, isEnded);
}

void MasterSession::Impl::EndOrderActions(MasterActions& out)
{
    const auto isOfOrder = [&out](const TrackedAction& tracked) {
        if (!tracked.bInstant)
        {
            out.emplace_back(ActionLost{tracked.actionID, tracked.actionType, "the order ended without word of it"});
        }
        return !tracked.bInstant;
    };
    std::erase_if(_tracked, isOfOrder);
}

void MasterSession::Impl::RemoveTrackedAction(std::string_view actionID)
{
    std::erase_if(_tracked, [actionID](const TrackedAction& tracked) { return tracked.actionID == actionID; });
}

std::vector<ReservedElement> MasterSession::Impl::ListReserved() const
{
    std::vector<ReservedElement> reserved;
    if (_state.has_value())
    {
        if (!_state->lastNodeID.empty())
        {
            reserved.push_back(ReservedElement{_state->lastNodeID, _state->lastNodeSequenceID, false, true});
        }
        for (const NodeState& node : _state->nodeStates)
        {
            if (node.bReleased)
            {
                reserved.push_back(ReservedElement{node.nodeID, node.sequenceID, false, true});
            }
        }
        for (const EdgeState& edge : _state->edgeStates)
        {
            if (edge.bReleased)
            {
                reserved.push_back(ReservedElement{edge.edgeID, edge.sequenceID, true, true});
            }
        }
        std::ranges::stable_sort(reserved, {}, &ReservedElement::sequenceID);
    }
    const std::optional<OrderMessage>& open = _inFlight.has_value() ? _inFlight : _withdrawn;
    if (!open.has_value() || (_inFlight.has_value() && _sendCount == 0))
    {
        return reserved;
    }
    std::vector<ReservedElement> sent;
    const auto add = [&reserved, &sent](const std::string& elementID, std::uint32_t sequenceID, bool bEdge) {
        const ReservedElement element{elementID, sequenceID, bEdge, true};
        if (std::ranges::find(reserved, element) == reserved.end())
        {
            sent.push_back(ReservedElement{elementID, sequenceID, bEdge, false});
        }
    };
    for (const OrderNode& node : open->nodes)
    {
        if (node.bReleased)
        {
            add(node.nodeID, node.sequenceID, false);
        }
    }
    for (const OrderEdge& edge : open->edges)
    {
        if (edge.bReleased)
        {
            add(edge.edgeID, edge.sequenceID, true);
        }
    }
    std::ranges::stable_sort(sent, {}, &ReservedElement::sequenceID);
    std::ranges::move(sent, std::back_inserter(reserved));
    return reserved;
}

} // namespace ACS::VDA5050

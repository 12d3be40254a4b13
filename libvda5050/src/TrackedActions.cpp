#include "TrackedActions.hpp"

#include <acs/vda5050/ActionMachine.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace ACS::VDA5050
{

void TrackedActions::TrackOrder(const OrderMessage& order, const std::set<std::string_view>& ofRoute, bool bUpdate)
{
    const auto isDropped = [&ofRoute](const TrackedAction& tracked) {
        return !tracked.bInstant && !ofRoute.contains(tracked.actionID);
    };
    std::erase_if(_actions, isDropped);
    std::set<std::string> known;
    for (const TrackedAction& tracked : _actions)
    {
        known.insert(tracked.actionID);
    }
    const auto track = [this, &known](const std::vector<Action>& actions) {
        for (const Action& action : actions)
        {
            if (known.insert(action.actionID).second)
            {
                _actions.push_back(TrackedAction{action.actionID, action.actionType, false, false});
            }
        }
    };
    // The node where an update begins has been tracked with the message before it.
    const std::size_t first = bUpdate ? 1 : 0;
    for (std::size_t index = first; index < order.nodes.size(); ++index)
    {
        track(order.nodes[index].actions);
    }
    for (const OrderEdge& edge : order.edges)
    {
        track(edge.actions);
    }
}

void TrackedActions::TrackInstant(const Action& action, bool bShown)
{
    _actions.push_back(TrackedAction{action.actionID, action.actionType, true, bShown});
}

void TrackedActions::Update(const ActionIndex& shown, MasterActions& out)
{
    const auto isEnded = [this, &shown, &out](TrackedAction& tracked) {
        const ActionState* const state = shown.FindOrNull(tracked.actionID);
        if (state != nullptr)
        {
            tracked.bShown = true;
            return IsTerminal(state->actionStatus);
        }
        if (tracked.bShown)
        {
            _bOrderActionLost = _bOrderActionLost || !tracked.bInstant;
            out.emplace_back(ActionLost{tracked.actionID, tracked.actionType, "the vehicle no longer reports it"});
        }
        return tracked.bShown;
    };
    std::erase_if(_actions, isEnded);
}

void TrackedActions::EndOrder(MasterActions& out)
{
    const auto isOfOrder = [&out](const TrackedAction& tracked) {
        if (!tracked.bInstant)
        {
            out.emplace_back(ActionLost{tracked.actionID, tracked.actionType, "the order ended without word of it"});
        }
        return !tracked.bInstant;
    };
    std::erase_if(_actions, isOfOrder);
    _bOrderActionLost = false;
}

void TrackedActions::Remove(std::string_view actionID)
{
    std::erase_if(_actions, [actionID](const TrackedAction& tracked) { return tracked.actionID == actionID; });
}

bool TrackedActions::IsTracked(std::string_view actionID) const
{
    return std::ranges::find(_actions, actionID, &TrackedAction::actionID) != _actions.end();
}

bool TrackedActions::HasShownOrderAction() const
{
    return std::ranges::any_of(_actions, [](const TrackedAction& tracked) {
        return !tracked.bInstant && tracked.bShown;
    });
}

bool TrackedActions::HasShownAllEnds() const
{
    return !_bOrderActionLost && std::ranges::all_of(_actions, &TrackedAction::bInstant);
}

} // namespace ACS::VDA5050

#pragma once

#include "ActionIndex.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The actions of a master that have not ended according to the vehicle's states. One that disappears is reported as lost.
class TrackedActions
{
    struct TrackedAction
    {
        std::string actionID;
        std::string actionType;
        bool bInstant = false;
        bool bShown = false;
    };

    std::vector<TrackedAction> _actions;
    bool _bOrderActionLost = false; ///< Of the present order.

public:
    /// Tracks the actions of a message that the vehicle has accepted, and no longer those that its route has dropped.
    void TrackOrder(const OrderMessage& order, const std::set<std::string_view>& ofRoute, bool bUpdate);
    void TrackInstant(const Action& action, bool bShown);
    void Update(const ActionIndex& shown, MasterActions& out);
    void EndOrder(MasterActions& out);
    void Remove(std::string_view actionID);

    /// Whether an order action or instant action with this id has not ended.
    [[nodiscard]] bool IsTracked(std::string_view actionID) const;
    /// Whether the vehicle shows an action of the order that has not ended.
    [[nodiscard]] bool HasShownOrderAction() const;
    /// Whether the vehicle has shown the end of every action of the order.
    [[nodiscard]] bool HasShownAllEnds() const;
};

} // namespace ACS::VDA5050

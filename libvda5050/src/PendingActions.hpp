#pragma once

#include "ActionIndex.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Instant actions that are resent until the vehicle shows or refuses them.
class PendingActions
{
    struct PendingAction
    {
        Action action;
        std::uint32_t sendCount = 0;
        std::optional<std::string> orderID; ///< Of the vehicle when the action was sent, once a state has shown it.
    };

    std::vector<PendingAction> _actions;

public:
    /// The action was sent once.
    void Add(Action action, std::optional<std::string> orderIDOrNull);
    /// False: the action is not pending.
    [[nodiscard]] bool TryRemove(std::string_view actionID);
    /// Ends the resends of what the state answers. Returns the ids of the actions that were rejected, which out reports.
    /// cancelActionID is the cancelOrder of the master's own order.
    [[nodiscard]] std::vector<std::string> OnState(
        const StateMessage& state,
        const ActionIndex& shown,
        std::string_view cancelActionID,
        MasterActions& out);
    /// Removes what was resent resendCount times, if that is not 0. Returns the ids, which out reports as rejected.
    [[nodiscard]] std::vector<std::string> TakeSpent(std::uint32_t resendCount, MasterActions& out);
    /// Counts a resend of all actions, and returns them.
    [[nodiscard]] std::vector<Action> Resend();

    [[nodiscard]] bool IsPending(std::string_view actionID) const;
    [[nodiscard]] bool IsEmpty() const noexcept;

private:
    /// The cancelOrder was for an order of another master, which has ended: sent again it would end the next order.
    [[nodiscard]] static bool IsCancelLate(const PendingAction& pending, const StateMessage& state);
};

} // namespace ACS::VDA5050

#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The order of another master, or one that was sent before a restart, which a vehicle executes. Its remaining route is cancelled, once
/// per order; running actions are not interrupted.
class ForeignOrder final
{
public:
    using ActionTest = std::function<bool(const VDA5050::ActionState& action)>;

private:
    std::string _cancelledID; ///< The latest order for which cancelOrder was sent.

public:
    /// According to the vehicle's state, while it has no drive and no job of its adapter. isOwn: whether an action is an instant action of
    /// acsd, which is of no order.
    [[nodiscard]] static bool IsExecuted(const VDA5050::StateMessage& state, const ActionTest& isOwn);

    /// Its nodes or edges are not all passed.
    [[nodiscard]] static bool IsDriven(const VDA5050::StateMessage& state);

    void OnConnected();
    /// While IsExecuted and the session has no order.
    void Cancel(VDA5050::MasterSession& session, Core::Now now, VDA5050::MasterActions& out);
};

} // namespace ACS::Acsd

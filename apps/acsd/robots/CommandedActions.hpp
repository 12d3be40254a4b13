#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The instant actions by which the engine pauses a vehicle and has it charge. A command withdraws the former one of its kind if the
/// vehicle has not shown it: sent again later, it would undo this one, and the actions that a vehicle never shows would become more
/// without end.
class CommandedActions final
{
    std::string _pauseID;  ///< Of the last startPause or stopPause; empty: none.
    std::string _chargeID; ///< Of the last startCharging or stopCharging; empty: none.

public:
    /// The type is one of these four.
    void Send(std::string_view actionType, VDA5050::MasterSession& session, Core::Now now, VDA5050::MasterActions& out);
    /// Whether the action is the last one of its kind, or charging that acsd may have begun before a restart.
    [[nodiscard]] bool IsCommanded(const VDA5050::ActionState& action) const noexcept;
};

} // namespace ACS::Acsd

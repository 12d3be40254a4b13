#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// Whether 2.x allows the change of an action's status (section 6.11; Paused to Failed is allowed because a cancel
/// needs it). No status changes to itself.
[[nodiscard]] ACS_API bool CanChangeStatus(EActionStatus from, EActionStatus to);

/// Whether this status is allowed as the first one of an action.
[[nodiscard]] ACS_API bool CanBeginWith(EActionStatus status);

/// Finished or Failed.
[[nodiscard]] ACS_API bool IsTerminal(EActionStatus status);

/// The name on the wire, for example "RUNNING".
[[nodiscard]] ACS_API std::string_view GetStatusText(EActionStatus status);

/// The reported state of one action; rejects transitions that the table forbids.
class ACS_API ActionMachine
{
    ActionState _state;

public:
    /// The action begins in this state; CanBeginWith lists what is allowed.
    explicit ActionMachine(ActionState initial);

    /// As it is reported in the vehicle's state.
    [[nodiscard]] const ActionState& GetState() const noexcept;
    /// The status of GetState.
    [[nodiscard]] EActionStatus GetStatus() const noexcept;

    /// Returns false and changes nothing if the table forbids the transition. Before the end, a new result description alone
    /// is allowed.
    [[nodiscard]] bool TrySet(EActionStatus status, std::string resultDescription = {});
};

} // namespace ACS::VDA5050

#pragma once

#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// Whether 2.x allows the change of an action's status (section 6.11; Paused to Failed is allowed because a cancel
/// needs it). No status changes to itself.
[[nodiscard]] bool CanChangeStatus(EActionStatus from, EActionStatus to);

/// Whether an action may be reported with this status first.
[[nodiscard]] bool CanBeginWith(EActionStatus status);

/// Finished or Failed.
[[nodiscard]] bool IsTerminal(EActionStatus status);

/// "WAITING", "RUNNING", … as on the wire; for logs.
[[nodiscard]] std::string_view GetStatusText(EActionStatus status);

/// The life of one action: keeps its reported state and refuses what the transition table forbids.
class ActionMachine
{
    ActionState _state;

public:
    explicit ActionMachine(ActionState initial);

    [[nodiscard]] const ActionState& GetState() const noexcept;
    [[nodiscard]] EActionStatus GetStatus() const noexcept;

    /// False, and nothing changed, where the table forbids it. A new result description alone is allowed before the end.
    [[nodiscard]] bool TrySet(EActionStatus status, std::string resultDescription = {});
};

} // namespace ACS::VDA5050

#include <acs/vda5050/ActionMachine.hpp>

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

constexpr std::uint8_t Bit(EActionStatus status)
{
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(status));
}

template <typename... TStatus>
constexpr std::uint8_t Set(TStatus... status)
{
    return static_cast<std::uint8_t>((0U | ... | Bit(status)));
}

struct StatusRow
{
    std::string_view text;
    std::uint8_t next;
};

/// The transition table, a row for each status in the order of the enumeration.
constexpr std::array<StatusRow, 6> ROWS{
    // Finished: an action that is done in the moment in which its node is reached.
    StatusRow{
        "WAITING",
        Set(EActionStatus::Initializing, EActionStatus::Running, EActionStatus::Finished, EActionStatus::Failed)},
    StatusRow{"INITIALIZING", Set(EActionStatus::Running, EActionStatus::Paused, EActionStatus::Failed)},
    StatusRow{"RUNNING", Set(EActionStatus::Paused, EActionStatus::Finished, EActionStatus::Failed)},
    StatusRow{"PAUSED", Set(EActionStatus::Initializing, EActionStatus::Running, EActionStatus::Failed)},
    StatusRow{"FINISHED", 0},
    StatusRow{"FAILED", 0}};

const StatusRow& GetRow(EActionStatus status)
{
    return ROWS.at(static_cast<std::size_t>(status));
}

} // namespace

bool CanChangeStatus(EActionStatus from, EActionStatus to)
{
    return (GetRow(from).next & Bit(to)) != 0;
}

bool CanBeginWith(EActionStatus status)
{
    return status != EActionStatus::Paused;
}

bool IsTerminal(EActionStatus status)
{
    return GetRow(status).next == 0;
}

std::string_view GetStatusText(EActionStatus status)
{
    return GetRow(status).text;
}

ActionMachine::ActionMachine(ActionState initial)
    : _state(std::move(initial))
{
    assert(CanBeginWith(_state.actionStatus));
}

const ActionState& ActionMachine::GetState() const noexcept
{
    return _state;
}

EActionStatus ActionMachine::GetStatus() const noexcept
{
    return _state.actionStatus;
}

bool ActionMachine::TrySet(EActionStatus status, std::string resultDescription)
{
    const bool bSame = status == _state.actionStatus && !IsTerminal(status);
    if (!bSame && !CanChangeStatus(_state.actionStatus, status))
    {
        return false;
    }
    _state.actionStatus = status;
    if (!resultDescription.empty())
    {
        _state.resultDescription = std::move(resultDescription);
    }
    return true;
}

} // namespace ACS::VDA5050

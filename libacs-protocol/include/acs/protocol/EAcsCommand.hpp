#pragma once

#include <acs/core/Api.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::Protocol
{

/// Every command of the protocol (sections 5.1 to 5.3 of the document), in the order of the alternatives of AcsPayload.
/// The Ack of a command has no enumerator of its own: its name is that of the command followed by `Ack`.
enum class EAcsCommand : std::uint8_t
{
    ExecutionPlan,
    CancelPlan,
    AbortPlan,
    PausePlan,
    ResumePlan,
    SyncConfig,
    RequestAcsPlans,
    RequestAcsPlanHistory,
    RequestAcsErrorList,
    Registration,
    TscStateUpdate,
    AcsCommStateUpdate,
    PlanReport,
    StepReport,
    JobReport,
    CancelResultReport,
    AbortResultReport,
    PauseResultReport,
    ResumeResultReport,
    ErrorReport,
    RobotStatusUpdate,
    RobotPositionUpdate,
};

/// Number of enumerators of EAcsCommand.
inline constexpr std::size_t COMMAND_COUNT = 22;

/// The name on the wire, without `Ack`.
[[nodiscard]] ACS_API std::string_view GetText(EAcsCommand command);

/// Whether the MCS sends this command; otherwise the ACS does.
[[nodiscard]] ACS_API bool IsSentByMCS(EAcsCommand command) noexcept;

/// Whether the receiver answers with an Ack: every command but RobotPositionUpdate (sections 6.1 and 6.19).
[[nodiscard]] ACS_API bool HasAck(EAcsCommand command) noexcept;

} // namespace ACS::Protocol

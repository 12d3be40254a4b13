#pragma once

#include <acs/core/Timestamp.hpp>
#include <acs/protocol/EAckResult.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/messages/AckPayloads.hpp>
#include <acs/protocol/messages/Errors.hpp>
#include <acs/protocol/messages/ExecutionPlan.hpp>
#include <acs/protocol/messages/PlanControl.hpp>
#include <acs/protocol/messages/PlanQueries.hpp>
#include <acs/protocol/messages/Registration.hpp>
#include <acs/protocol/messages/Reports.hpp>
#include <acs/protocol/messages/RobotPosition.hpp>
#include <acs/protocol/messages/RobotStatus.hpp>
#include <acs/protocol/messages/States.hpp>
#include <acs/protocol/messages/SyncConfig.hpp>

#include <string>
#include <variant>

namespace ACS::Protocol
{

/// The payload of a request. Its alternative is the command (GetCommand).
using AcsPayload = std::variant<
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
    RobotPositionUpdate>;

static_assert(std::variant_size_v<AcsPayload> == COMMAND_COUNT);

/// The payload of an Ack. AckPayloads.hpp states which command has which alternative.
using AckPayload = std::variant<EmptyAck, PlanAck, PlanListAck, ErrorListAck>;

/// A request, in either direction (section 6.1).
struct AcsRequest
{
    std::string transactionID;
    Core::Timestamp timestamp; ///< To the millisecond; the epoch if missing or unreadable.
    AcsPayload payload;

    bool operator==(const AcsRequest&) const = default;
};

/// A response (section 6.1).
struct AcsAck
{
    EAcsCommand command = EAcsCommand::ExecutionPlan; ///< Of the request.
    std::string transactionID;                        ///< Of the request.
    Core::Timestamp timestamp;
    EAckResult result = EAckResult::Success;
    std::string message; ///< For the operator; may be empty.
    AckPayload payload;
    bool bLegacyName = false; ///< RequestAcsPlans under its old name, RequestAcsStatus (D-5).

    bool operator==(const AcsAck&) const = default;
};

/// Any text of the protocol: a request or a response.
using AcsMessage = std::variant<AcsRequest, AcsAck>;

/// The command that has this payload.
[[nodiscard]] inline EAcsCommand GetCommand(const AcsPayload& payload) noexcept
{
    return static_cast<EAcsCommand>(payload.index());
}

/// The command of the request, according to its payload.
[[nodiscard]] inline EAcsCommand GetCommand(const AcsRequest& request) noexcept
{
    return GetCommand(request.payload);
}

} // namespace ACS::Protocol

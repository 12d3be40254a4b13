#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::AcsSim
{

/// The rules of MCS-ACS 1.4.1 that bind the MCS, in the order of the table.
enum class ERule : std::uint8_t
{
    RegistrationAnswered,
    NothingBeforeRegistration,
    Reconnected,
    JsonObject,
    Envelope,
    TransactionID,
    Timestamp,
    KnownCommand,
    RequestPayload,
    Acknowledged,
    AcknowledgedOnce,
    AckTransaction,
    AckCommand,
    AckResult,
    ReportAccepted,
    ReportRepeated,
    ReportAfterReconnect,
    UndefinedPayload,
    UnknownCommand,
    MalformedText,
    PositionUnanswered,
    PlanPayload,
    PlanLocation,
    PlanSteps,
    PlanAction,
    PlanCarriers,
    PlanID,
    PlansWithheld,
    ControlOfKnownPlan,
};

inline constexpr std::size_t RULE_COUNT = 29;

/// "ack-once": for the table and for tests.
[[nodiscard]] std::string_view GetName(ERule rule);
/// Of MCS-ACS 1.4.1: "6.1".
[[nodiscard]] std::string_view GetSection(ERule rule);
/// What the MCS must do, in one sentence.
[[nodiscard]] std::string_view GetMeaning(ERule rule);

} // namespace ACS::AcsSim

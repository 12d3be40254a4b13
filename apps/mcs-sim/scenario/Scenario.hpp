#pragma once

#include "plans/PlannedPlan.hpp"
#include "wire/AckHold.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/protocol/EAcsCommand.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::McsSim
{

/// What a message must be like: JSON in which strings may hold placeholders ("{A}": the planId of the plan that the
/// scenario calls A) and the wildcard '*'.
struct MessagePattern
{
    std::string command;    ///< As on the wire, "PlanReport" or "CancelPlanAck".
    Core::JsonText members; ///< An object; each of its members must be in the message and match.
    bool bRepeated = false; ///< Only a message whose transactionId came before, in the same scenario.

    bool operator==(const MessagePattern&) const = default;
};

/// Sends a plan that is new, or one that was sent before once more.
struct SendPlanStep
{
    PlannedPlan plan;
    std::string name;
    std::size_t times = 1; ///< Number of copies; with fresh ids only. The name refers to the last one.
    bool bFreshIDs = false;

    bool operator==(const SendPlanStep&) const = default;
};

struct SendAgainStep
{
    std::string name;
    bool bFreshTransaction = false; ///< Else it is the same message as before.

    bool operator==(const SendAgainStep&) const = default;
};

/// Any other request of an MCS.
struct SendRequestStep
{
    Protocol::EAcsCommand command = Protocol::EAcsCommand::RequestAcsPlans;
    Core::JsonText payload; ///< May hold placeholders; it can be decoded with or without them.

    bool operator==(const SendRequestStep&) const = default;
};

/// A text that may be no message at all.
struct SendTextStep
{
    std::string text;

    bool operator==(const SendTextStep&) const = default;
};

/// Waits for a message.
struct ExpectStep
{
    MessagePattern pattern;
    std::chrono::milliseconds within{0};
    std::string name; ///< By which the message is spoken of later; may be empty.

    bool operator==(const ExpectStep&) const = default;
};

/// Waits for these messages, in any order, and none may come in between.
struct ExpectNextStep
{
    std::vector<MessagePattern> patterns; ///< At least one.
    std::chrono::milliseconds within{0};
    std::string besides; ///< But for those of this command; may be empty.

    bool operator==(const ExpectNextStep&) const = default;
};

/// Waits, and no such message may come.
struct ExpectNothingStep
{
    MessagePattern pattern;
    std::chrono::milliseconds duration{0};

    bool operator==(const ExpectNothingStep&) const = default;
};

/// Waits until the last PlanReport of a plan has this status.
struct WaitForPlanStep
{
    std::string name;
    Protocol::EPlanStatus status = Protocol::EPlanStatus::Completed;
    std::chrono::milliseconds within{0};

    bool operator==(const WaitForPlanStep&) const = default;
};

struct WaitStep
{
    std::chrono::milliseconds duration{0};

    bool operator==(const WaitStep&) const = default;
};

/// What a person, or a program beside, is to do now at the ACS.
struct AskStep
{
    std::string text;

    bool operator==(const AskStep&) const = default;
};

enum class EDrop : std::uint8_t
{
    Cut,   ///< The socket goes, as with a cut cable.
    Close, ///< With a closing handshake.
};

struct DropStep
{
    EDrop how = EDrop::Cut;
    std::uint16_t code = Protocol::CLOSE_NORMAL; ///< Of the closing handshake.

    bool operator==(const DropStep&) const = default;
};

struct HoldAcksStep
{
    AckHold hold;

    bool operator==(const HoldAcksStep&) const = default;
};

struct RefuseRegistrationStep
{
    std::size_t times = 1;
    std::string message;

    bool operator==(const RefuseRegistrationStep&) const = default;
};

using ScenarioStepKind = std::variant<
    SendPlanStep,
    SendAgainStep,
    SendRequestStep,
    SendTextStep,
    ExpectStep,
    ExpectNextStep,
    ExpectNothingStep,
    WaitForPlanStep,
    WaitStep,
    AskStep,
    DropStep,
    HoldAcksStep,
    RefuseRegistrationStep>;

struct ScenarioStep
{
    ScenarioStepKind kind;
    std::string title; ///< One line for people.

    bool operator==(const ScenarioStep&) const = default;
};

/// The contents of a scenario file; docs/reference/mcs-sim.md describes the format.
struct Scenario
{
    std::string name;
    std::chrono::milliseconds within{0}; ///< How long an action waits until an ACS is registered.
    std::vector<ScenarioStep> steps;     ///< At least one.

    bool operator==(const Scenario&) const = default;
};

} // namespace ACS::McsSim

#pragma once

#include "scenario/Scenario.hpp"
#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <string>
#include <variant>
#include <vector>

namespace ACS::McsSim
{

/// Send this plan now, under its transactionID.
struct SendPlannedPlan
{
    PlannedPlan planned;
    bool bFreshIDs = false; ///< The plan was created for this run.

    bool operator==(const SendPlannedPlan&) const = default;
};

/// Send a request with a transactionId of its own.
struct SendPayload
{
    Protocol::AcsPayload payload;

    bool operator==(const SendPayload&) const = default;
};

struct SendRawText
{
    std::string text;

    bool operator==(const SendRawText&) const = default;
};

/// Acks go at once again, and registrations are accepted.
struct EndFaults
{
    bool operator==(const EndFaults&) const = default;
};

/// Call OnTimer after the delay. Replaces one that runs.
struct StartScenarioTimer
{
    std::chrono::milliseconds delay{0};

    bool operator==(const StartScenarioTimer&) const = default;
};

/// A line for people.
struct PrintLine
{
    std::string text;

    bool operator==(const PrintLine&) const = default;
};

/// What a scenario wants done, in this order.
using ScenarioAction = std::variant<
    SendPlannedPlan,
    SendPayload,
    SendRawText,
    DropStep,
    HoldAcksStep,
    RefuseRegistrationStep,
    EndFaults,
    StartScenarioTimer,
    PrintLine>;
using ScenarioActions = std::vector<ScenarioAction>;

} // namespace ACS::McsSim

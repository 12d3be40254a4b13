#pragma once

#include "robots/ArmAnswers.hpp"
#include "robots/ArmFact.hpp"
#include "robots/ArmRelay.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace ACS::Acsd::ArmViews
{

struct Counters
{
    bool bFresh = false; ///< A sample has arrived since they were requested.
};

/// The general state is observed for the effect of a CONTROL.
struct Effect
{
    std::optional<GeneralState> stateOrNull; ///< The latest.
};

/// A CONTROL without an answer may be accepted, lost or delayed. So the MONITOR of the counters is sent again: its first
/// sample is newer than the CONTROL.
struct Verification
{
    bool bAccepted = false;                  ///< Accepted by the controller: the next sample is newer than the CONTROL.
    std::optional<GeneralState> stateOrNull; ///< The latest that was shown after the CONTROL.
};

struct Probe
{
    EArmProbe kind = EArmProbe::Motor;
    bool bAccepted = false;
};

struct Relays
{
    std::vector<ArmRelayRange> ranges;
    std::vector<ArmRelayWords> read; ///< One for each range that was read.
    bool bAccepted = false;          ///< The controller has accepted the MONITOR of the present range.
};

/// What MONITOR shows at present.
using ArmView = std::variant<Counters, Effect, Verification, Probe, Relays>;

} // namespace ACS::Acsd::ArmViews

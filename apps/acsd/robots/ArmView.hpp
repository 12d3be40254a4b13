#pragma once

#include "robots/ArmFact.hpp"
#include "robots/ArmRelay.hpp"

#include <variant>
#include <vector>

namespace ACS::Acsd::ArmViews
{

struct Counters
{
    bool bFresh = false; ///< One has come since they were asked for.
};

/// The general state is to show the effect of a CONTROL.
struct Effect
{
};

/// A CONTROL is answered by silence, also where it got lost or takes its time. So the MONITOR of the counters is sent
/// again: its first sample is of the time after the CONTROL.
struct Verification
{
    bool bTaken = false; ///< By the controller: the next sample is the one.
};

struct Probe
{
    EArmProbe kind = EArmProbe::Motor;
    bool bTaken = false;
};

struct Relays
{
    std::vector<ArmRelayRange> ranges;
    std::vector<ArmRelayWords> read; ///< One for each of the ranges that were read.
    bool bTaken = false;             ///< The MONITOR of the present range.
};

/// What MONITOR shows at present.
using ArmView = std::variant<Counters, Effect, Verification, Probe, Relays>;

} // namespace ACS::Acsd::ArmViews

#pragma once

#include "robots/ArmAnswers.hpp"
#include "robots/ArmJobEvidence.hpp"
#include "robots/ArmRelay.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// What a probe reads for one sample in place of the counters.
enum class EArmProbe : std::uint8_t
{
    Motor,
    Playback, ///< Whether a program runs.
};

/// The words that a range of relays shows.
struct ArmRelayWords
{
    ArmRelayRange range;
    std::vector<std::int64_t> words;
};

/// Fact: a sample of the counters.
struct ArmCounted
{
    ArmSample sample;
    bool bFirst = false;    ///< The first of the connection, or since the counters were missing.
    bool bVerifies = false; ///< It is newer than the CONTROL that is being verified.
    /// Of a sample that verifies: the latest that was shown after the CONTROL.
    std::optional<GeneralState> stateOrNull;
};

/// Fact: the controller's general state, while it is watched for the effect of a CONTROL.
struct ArmEffectShown
{
    GeneralState state;
};

/// Fact: a probe has ended; without a value where the controller did not answer it.
struct ArmProbed
{
    EArmProbe probe = EArmProbe::Motor;
    std::optional<bool> bOnOrNull; ///< The motor is on, or a program runs.
    /// Of a probe of playback: the program that is selected, where it is shown.
    std::optional<std::int64_t> programOrNull;
};

/// Fact: all ranges of relays were read once.
struct ArmRelaysRead
{
    std::vector<ArmRelayWords> ranges;
};

/// Fact: the controller does not show a range.
struct ArmRelaysRefused
{
    std::string reason;
};

using ArmFact = std::variant<std::monostate, ArmCounted, ArmEffectShown, ArmProbed, ArmRelaysRead, ArmRelaysRefused>;

} // namespace ACS::Acsd

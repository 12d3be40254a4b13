#pragma once

#include "common/faults/FaultBase.hpp"
#include "common/faults/FaultBoard.hpp"
#include "common/faults/FaultCommand.hpp"
#include "common/faults/FaultGrammar.hpp"
#include <acs/core/Now.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace ACS::OpenStreamSim
{

/// Faults of a simulated controller.
enum class EFaultKind : std::uint8_t
{
    Silence,
    Hole,
    Drop,
    Slow,
    Refuse,
    Mode,
    EmergencyStop,
    ProtectiveStop,
    MotorOff,
    ProgramFails,
    WrongValue,
};

/// The interface of the controller that a fault affects.
enum class EFaultSide : std::uint8_t
{
    Stream,
    Http,
    Both,
};

/// One fault with its parameters; docs/reference/openstream-sim.md has the table of kinds. The place is the number of a
/// program that begins.
struct Fault : Apps::FaultBase<EFaultKind>
{
    // Each applies to the kinds that have it.
    Core::Duration time{};    ///< Slow: of each answer.
    Core::Duration silence{}; ///< Mode: of the stream, at each turn of the switch.
    EFaultSide side = EFaultSide::Both;
    int status = 403;
    std::int32_t code = -1554; ///< The err_code; by default that of alarm E01554, not playing.
    bool bAtStart = false;

    bool operator==(const Fault&) const = default;
};

using FaultBoard = Apps::FaultBoard<Fault>;
using FaultChange = Apps::FaultChange<Fault>;
using FaultChanges = std::vector<FaultChange>;
using FaultCommand = Apps::FaultCommand<Fault>;

/// Grammar of the faults of a controller.
[[nodiscard]] const Apps::FaultGrammar<Fault>& GetFaultGrammar();

} // namespace ACS::OpenStreamSim

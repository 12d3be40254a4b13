#pragma once

#include "vda-sim/Fault.hpp"
#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

enum class EFaultVerb : std::uint8_t
{
    Begin,
    End,
    Trigger,
};

/// One line of a fault file, of the control topic or of --fault: "VEHICLES FAULT [KEY=VALUE]…", "VEHICLES end [FAULT]" or
/// "VEHICLES trigger", which is what a waitForTrigger waits for.
struct FaultCommand
{
    std::string vehicles; ///< A name, or its beginning and `*`.
    EFaultVerb verb = EFaultVerb::Begin;
    Fault fault;                         ///< Begin.
    std::optional<EFaultKind> kindToEnd; ///< End; absent: all of them.

    bool operator==(const FaultCommand&) const = default;
};

/// At most 1000 bytes of UTF-8. The error is about this one line.
[[nodiscard]] Core::Result<FaultCommand> ParseFaultCommand(std::string_view line);

/// A whole file or message of at most 1000 commands; empty lines and what follows a `#` are passed over. The path of an error begins with
/// "line N".
[[nodiscard]] Core::Result<std::vector<FaultCommand>> ParseFaultCommands(std::string_view text);

/// Whether the command is for the vehicle of this name.
[[nodiscard]] bool IsFor(const FaultCommand& command, std::string_view name);

} // namespace ACS::VdaSim

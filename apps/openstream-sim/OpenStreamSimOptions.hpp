#pragma once

#include "common/config/CommandLine.hpp"
#include "common/trace/TraceOptions.hpp"
#include "controller/ControllerFleet.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

inline constexpr std::string_view PROGRAM_NAME = "openstream-sim";

struct OpenStreamSimOptions
{
    FleetOptions fleet;
    std::string worldFile;   ///< Empty: no floor.
    std::string programFile; ///< Empty: programs only take their time.
    Apps::TraceOptions trace;
    bool bRealTime = false;
    Apps::CommonOptions common;
};

/// Reads "NUMBER=DURATION" or "NUMBER=DURATION,fail" into the options. Returns an empty text, or what was expected and found.
[[nodiscard]] std::string ParseProgram(std::string_view text, ControllerOptions& options);

/// Reads the command line. Returns the exit code if the program is to end.
[[nodiscard]] std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, OpenStreamSimOptions& options);

} // namespace ACS::OpenStreamSim

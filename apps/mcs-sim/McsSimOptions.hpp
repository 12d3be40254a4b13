#pragma once

#include "common/config/CommandLine.hpp"
#include "common/config/Endpoint.hpp"
#include "wire/Profile.hpp"
#include <acs/protocol_beast/TlsOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

constexpr std::string_view PROGRAM_NAME = "mcs-sim";

enum class ELiveMode : std::uint8_t
{
    Auto, ///< Where standard output is a terminal.
    Always,
    Never,
};

/// The command line.
struct McsSimOptions
{
    Apps::CommonOptions common;
    Apps::Endpoint listen{"127.0.0.1", 9001};
    std::string path = "/acs/";
    std::optional<ProtocolBeast::TlsOptions> tls; ///< There: wss.
    std::vector<std::string> planFiles;           ///< At least one, or scenarios instead, or the console.
    std::vector<std::string> scenarioFiles;
    std::size_t repeat = 1;
    bool bFreshIDs = false;
    ELiveMode liveMode = ELiveMode::Auto;
    bool bKeep = false;
    bool bWaitForEnter = false;
    std::string traceFile; ///< Empty: none.
    EProfile profile = EProfile::Spec;
    bool bConsole = false;
    std::string worldFile; ///< Empty: none.
    bool bRestock = true;  ///< With a world file.
};

/// Sets the options. Nullopt: continue; otherwise the exit code, after all output was printed.
[[nodiscard]] std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, McsSimOptions& options);

} // namespace ACS::McsSim

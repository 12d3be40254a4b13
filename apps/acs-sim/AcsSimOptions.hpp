#pragma once

#include "common/config/CommandLine.hpp"
#include "common/config/Url.hpp"
#include "faults/FaultSchedule.hpp"
#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::AcsSim
{

constexpr std::string_view PROGRAM_NAME = "acs-sim";

/// The command line.
struct AcsSimOptions
{
    Apps::CommonOptions common;
    Apps::Url url{Apps::EUrlScheme::Ws, {"127.0.0.1", 9001}, "/acs/"};
    ProtocolBeast::HttpHeaders headers;
    ProtocolBeast::TlsOptions tls;
    std::vector<std::string> robots; ///< Empty: LR01 and CR01.
    std::vector<FaultOrder> faults;
    std::size_t plans = 0;                 ///< 0: the number does not end the run.
    std::chrono::milliseconds duration{0}; ///< 0: the time does not end the run.
    std::chrono::milliseconds ackTimeout{5'000};
    std::size_t queue = 100;
    double timeScale = 1.0;
};

/// Sets the options. Nullopt: continue; otherwise the exit code, after all output was printed.
[[nodiscard]] std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, AcsSimOptions& options);

} // namespace ACS::AcsSim

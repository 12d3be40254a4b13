#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/trace/TraceFiles.hpp"
#include <acs/core/Logger.hpp>

#include <chrono>

namespace ACS::Acsd
{

/// What acsd shows of itself and how patient it is, besides its links.
struct OperationsConfig
{
    Core::ELogLevel logLevel = Core::ELogLevel::Info;
    Apps::TraceLimits trace;
    std::chrono::milliseconds workGrace{10'000}; ///< `comm.grace`: without broker or robots before isConnected=false.
    std::chrono::milliseconds offlineAfter{15'000}; ///< `robot.offline_after`: of silence; see RobotHost.
    /// `robot.load_timeout`: for a vehicle's loads to agree with the end of its action.
    std::chrono::milliseconds loadTimeout{10'000};
    std::chrono::milliseconds statusInterval{0};   ///< `robot.status_interval`; 0: only changes are told.
    std::chrono::milliseconds drainTimeout{3'000}; ///< `shutdown.drain_timeout`: for reports to reach the MCS.

    bool operator==(const OperationsConfig&) const = default;
};

/// Reads the tables `log`, `trace`, `comm`, `robot` and `shutdown`.
void ReadOperationsConfig(const Apps::ConfigSection& root, OperationsConfig& config);

} // namespace ACS::Acsd

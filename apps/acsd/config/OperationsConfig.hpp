#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/trace/TraceFiles.hpp"
#include <acs/core/Logger.hpp>

#include <chrono>

namespace ACS::Acsd
{

/// Logging, tracing and time limits that do not belong to one link.
struct OperationsConfig
{
    Core::ELogLevel logLevel = Core::ELogLevel::Info;
    /// `log.stall_limit`: time for which the event loop may be blocked before this is logged and counted.
    std::chrono::milliseconds stallLimit{500};
    Apps::TraceLimits trace;
    /// `comm.grace`: time without broker or robots before isConnected=false is reported.
    std::chrono::milliseconds workGrace{10'000};
    /// `robot.offline_after`: silence of a vehicle before it counts as offline.
    std::chrono::milliseconds offlineAfter{15'000};
    /// `robot.load_timeout`: maximum time for a vehicle's loads to agree with the end of its action.
    std::chrono::milliseconds loadTimeout{10'000};
    /// `robot.status_interval`; 0: only changes are reported.
    std::chrono::milliseconds statusInterval{0};
    /// `shutdown.drain_timeout`: maximum time for the MCS to acknowledge all reports.
    std::chrono::milliseconds drainTimeout{3'000};

    bool operator==(const OperationsConfig&) const = default;
};

/// Reads the tables `log`, `trace`, `comm`, `robot` and `shutdown`.
void ReadOperationsConfig(const Apps::ConfigSection& root, OperationsConfig& config);

} // namespace ACS::Acsd

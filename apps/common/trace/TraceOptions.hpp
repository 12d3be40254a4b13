#pragma once

#include "common/trace/TraceFiles.hpp"

#include <string>

namespace CLI
{
class App;
} // namespace CLI

namespace ACS::Apps
{

/// Where a simulator writes its trace.
struct TraceOptions
{
    std::string folder; ///< Empty: no trace.
    TraceLimits limits{};
};

/// Adds --trace DIR, --trace-max-file-bytes BYTES and --trace-max-files N. The options must outlive parsing.
void AddTraceOptions(CLI::App& app, TraceOptions& options);

} // namespace ACS::Apps

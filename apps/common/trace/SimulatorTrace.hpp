#pragma once

#include "common/trace/TraceLine.hpp"
#include "common/trace/TraceOptions.hpp"
#include "common/trace/TraceWriter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <tl/expected.hpp>

#include <memory>
#include <string>

namespace ACS::Apps
{

/// The trace of a simulator: numbered files in a folder ("vda-sim-000001.ndjson" and up), written without waiting for the disk.
/// Called on one thread.
class SimulatorTrace final
{
    const Core::IClock& _clock;
    Core::Logger _logger;
    const std::string _program;
    const std::string _folder;
    TraceWriter _writer;
    bool _bKept = false; ///< There was a line: the start did not fail.

    SimulatorTrace(std::string program, const TraceOptions& options, const Core::IClock& clock, Core::Logger logger);

public:
    SimulatorTrace(const SimulatorTrace&) = delete;
    SimulatorTrace& operator=(const SimulatorTrace&) = delete;

    /// Writes the remaining lines. Missing lines are logged.
    ~SimulatorTrace();

    /// Opens a file in the folder of the options, which is created if necessary. The oldest files are deleted with the first line; a
    /// trace without lines leaves no file. The error is one sentence. The clock and the sink of
    /// the logger outlive the trace.
    [[nodiscard]] static tl::expected<std::unique_ptr<SimulatorTrace>, std::string> Create(
        const std::string& program,
        const TraceOptions& options,
        const Core::IClock& clock,
        const Core::Logger& logger);
    /// Adds a line with the name of the program. The time is that of receiving, or that before sending.
    void Write(TraceLine line, Core::Now now);
    /// Likewise, with the present time.
    void Write(const TraceLine& line);

    [[nodiscard]] Core::Now GetNow() const;
};

} // namespace ACS::Apps

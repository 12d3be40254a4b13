#include "common/trace/SimulatorTrace.hpp"

#include <fmt/format.h>

#include <functional>
#include <system_error>
#include <utility>

namespace ACS::Apps
{

SimulatorTrace::SimulatorTrace(
    std::string program,
    const TraceOptions& options,
    const Core::IClock& clock,
    Core::Logger logger)
    : _clock(clock),
      _logger(std::move(logger)),
      _program(std::move(program)),
      _folder(options.folder),
      _writer(
          {options.folder,
           options.limits,
           std::bind_front(&MakeLossLine, _program),
           TraceWriter::DEFAULT_QUEUE_BYTES,
           {.prefix = _program + "-", .bDeletedLater = true}},
          clock,
          _logger)
{
}

tl::expected<std::unique_ptr<SimulatorTrace>, std::string> SimulatorTrace::Create(
    const std::string& program,
    const TraceOptions& options,
    const Core::IClock& clock,
    const Core::Logger& logger)
{
    // The constructor is private.
    std::unique_ptr<SimulatorTrace> trace(new SimulatorTrace(program, options, clock, logger));
    if (const std::error_code error = trace->_writer.Open())
    {
        const bool bBusy = error == std::errc::device_or_resource_busy;
        return tl::make_unexpected(fmt::format(
            "--trace: cannot write to the folder {}: {}{}",
            options.folder,
            DescribeTraceError(error),
            bBusy ? "" : "; give a folder in which this user may create files (it is created if necessary)"));
    }
    return trace;
}

SimulatorTrace::~SimulatorTrace()
{
    _writer.Close();
    if (const std::uint64_t lost = _writer.GetLost(); lost > 0)
    {
        _logger.Warning("lines are missing in the trace", {{"path", _folder}, {"count", fmt::to_string(lost)}});
    }
}

void SimulatorTrace::Write(TraceLine line, Core::Now now)
{
    if (!std::exchange(_bKept, true))
    {
        _writer.Keep();
    }
    line.program = _program;
    _writer.Write(MakeTraceLine(line, now), now);
}

void SimulatorTrace::Write(const TraceLine& line)
{
    Write(line, _clock.GetNow());
}

Core::Now SimulatorTrace::GetNow() const
{
    return _clock.GetNow();
}

} // namespace ACS::Apps

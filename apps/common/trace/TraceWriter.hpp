#pragma once

#include "common/trace/TraceFiles.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace ACS::Apps
{

/// Writes the lines of a trace on a thread of its own: the caller never waits for the disk. Lines are lost if the queue or the
/// disk is full. Lost lines are counted, also by a line in the trace. Called on one thread.
class TraceWriter final
{
public:
    /// The line of the trace (without its end) that states a number of lost lines.
    using LossFormat = std::function<std::string(std::uint64_t lost, Core::Now now)>;

    static constexpr std::size_t DEFAULT_QUEUE_BYTES = 32U * 1024U * 1024U;

    struct Options
    {
        std::string path; ///< Path of the folder or of the file.
        TraceLimits limits;
        LossFormat makeLossLine; ///< Called on the writer's thread.
        std::size_t maxQueuedBytes = DEFAULT_QUEUE_BYTES;
        TraceFileStyle files{};
        std::string subject = "trace"; ///< In log lines.
    };

private:
    struct Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// The clock and the sink of the logger outlive the writer.
    TraceWriter(Options options, const Core::IClock& clock, Core::Logger logger);
    TraceWriter(const TraceWriter&) = delete;
    TraceWriter& operator=(const TraceWriter&) = delete;

    /// Calls Close.
    ~TraceWriter();

    /// Opens the first file and starts the thread. Call it once, before any other function.
    [[nodiscard]] std::error_code Open();

    /// With TraceFileStyle::bDeletedLater: the program has started, and the oldest files are deleted. Without this call, Close
    /// deletes the file that Open has created.
    void Keep();

    /// Queues a line without its line end; now is the time of the message. Calls LogState.
    void Write(std::string line, Core::Now now);

    /// Logs that the trace cannot be written, or is written again, if that is new. Call it now and then if lines are rare.
    void LogState();

    /// Takes effect with the next file.
    void SetLimits(const TraceLimits& limits);

    /// Waits until all lines are written. Write must not be called after it. Calls LogState.
    void Close();

    /// Number of lines that are missing in the trace.
    [[nodiscard]] std::uint64_t GetLost() const;
};

} // namespace ACS::Apps

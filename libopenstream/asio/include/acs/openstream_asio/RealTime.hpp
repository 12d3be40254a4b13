#pragma once

#include <acs/core/Api.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace ACS::OpenStreamAsio
{

/// Scheduling of a thread with a short period. Everything is off by default: a real-time program can starve all others.
struct ACS_API RealTimeOptions
{
    int priority = 0; ///< SCHED_FIFO priority, 1 to 99; 0: unchanged. Requires CAP_SYS_NICE or a limit for rtprio.
    /// Timer slack: by how much the kernel may delay a timer in order to combine several, 50 µs by default; 0: unchanged.
    std::chrono::nanoseconds timerSlack{0};
    bool bLockMemory = false; ///< Lock all memory of the process, so that no page is read from disk later.

    /// All three, with values suitable for the Open Stream at 2 ms.
    [[nodiscard]] static RealTimeOptions MakeAll();
};

/// Configures the calling thread; threads that it starts later inherit priority and slack. Never fails: returns a sentence
/// for each setting that the system refused, with the remedy, and leaves that setting unchanged.
[[nodiscard]] ACS_API std::vector<std::string> TuneThread(const RealTimeOptions& options);

} // namespace ACS::OpenStreamAsio

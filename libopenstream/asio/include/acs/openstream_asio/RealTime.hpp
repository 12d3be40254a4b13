#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace ACS::OpenStreamAsio
{

/// What helps a thread to keep a short period. Everything is off at first: a program that is given too much of the machine
/// can stop all else on it.
struct RealTimeOptions
{
    int priority =
        0; ///< SCHED_FIFO, 1 to 99; 0 leaves the scheduling as it is. Needs CAP_SYS_NICE or a limit for rtprio.
    /// How late the kernel may fire a timer so as to fire several at once, 50 µs by default; 0 leaves it as it is.
    std::chrono::nanoseconds timerSlack{0};
    bool bLockMemory =
        false; ///< The whole process's, now and later: no page of it is read from disk at the wrong moment.

    /// All three, with values that do for the Open Stream at 2 ms.
    [[nodiscard]] static RealTimeOptions MakeAll();
};

/// Tunes the calling thread; threads that it starts later inherit priority and slack. Never fails: returns a sentence for
/// each wish that the system did not grant and says what would make it, and the program runs as it would have without.
[[nodiscard]] std::vector<std::string> TuneThread(const RealTimeOptions& options);

} // namespace ACS::OpenStreamAsio

#include <acs/openstream_asio/RealTime.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#endif

namespace ACS::OpenStreamAsio
{

namespace
{

#ifdef __linux__

std::string Describe(int error)
{
    return std::generic_category().message(error);
}

void SetPriority(int priority, std::vector<std::string>& refusals)
{
    sched_param parameters{};
    parameters.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    if (error != 0)
    {
        refusals.push_back(fmt::format(
            "the thread keeps its ordinary priority, SCHED_FIFO {} was refused ({}): ask for 1 to 99, and give the program "
            "CAP_SYS_NICE or a limit for rtprio",
            priority,
            Describe(error)));
    }
}

void SetTimerSlack(std::chrono::nanoseconds slack, std::vector<std::string>& refusals)
{
    // A negative number would become a very long one.
    const bool bSet =
        slack.count() > 0 && prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(slack.count()), 0UL, 0UL, 0UL) == 0;
    if (!bSet)
    {
        refusals.push_back(fmt::format(
            "the thread keeps its timer slack, {} ns was refused ({}): ask for 1 ns or more",
            slack.count(),
            Describe(slack.count() > 0 ? errno : EINVAL)));
    }
}

void LockMemory(std::vector<std::string>& refusals)
{
    if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    {
        refusals.push_back(fmt::format(
            "the program's memory is not locked ({}): give it CAP_IPC_LOCK or a larger limit for memlock",
            Describe(errno)));
    }
}

#else

void SetPriority(int /*priority*/, std::vector<std::string>& refusals)
{
    refusals.emplace_back("the thread keeps its ordinary priority: only Linux is known to this library");
}

void SetTimerSlack(std::chrono::nanoseconds /*slack*/, std::vector<std::string>& refusals)
{
    refusals.emplace_back("the thread keeps its timers' precision: only Linux is known to this library");
}

void LockMemory(std::vector<std::string>& refusals)
{
    refusals.emplace_back("the program's memory is not locked: only Linux is known to this library");
}

#endif

} // namespace

RealTimeOptions RealTimeOptions::MakeAll()
{
    constexpr int PRIORITY = 20; // below the kernel's own threads that serve interrupts
    RealTimeOptions options;
    options.priority = PRIORITY;
    options.timerSlack = std::chrono::nanoseconds(1);
    options.bLockMemory = true;
    return options;
}

std::vector<std::string> TuneThread(const RealTimeOptions& options)
{
    std::vector<std::string> refusals;
    if (options.priority != 0)
    {
        SetPriority(options.priority, refusals);
    }
    if (options.timerSlack.count() != 0)
    {
        SetTimerSlack(options.timerSlack, refusals);
    }
    if (options.bLockMemory)
    {
        LockMemory(refusals);
    }
    return refusals;
}

} // namespace ACS::OpenStreamAsio

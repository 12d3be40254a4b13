#include "ProcessProbe.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <sched.h>
#include <stdexcept>
#include <tuple>
#include <unistd.h>

namespace ACS::Load::ProcessProbe
{
namespace
{

std::ifstream OpenFile(pid_t process, const char* name)
{
    std::ifstream file(fmt::format("/proc/{}/{}", process, name));
    if (!file)
    {
        throw std::runtime_error(fmt::format("process {} has ended", process));
    }
    return file;
}

} // namespace

double GetCpuSeconds(pid_t process)
{
    // Not /proc/PID/stat, which counts in ticks of 10 ms.
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0)
    {
        throw std::runtime_error(fmt::format("process {} has ended", process));
    }
    return std::chrono::duration<double>(std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec))
        .count();
}

std::int64_t GetResidentKiB(pid_t process)
{
    std::int64_t allPages = 0;
    std::int64_t residentPages = 0;
    OpenFile(process, "statm") >> allPages >> residentPages;
    return residentPages * sysconf(_SC_PAGESIZE) / 1024;
}

void KeepOnCore(pid_t process, std::size_t core)
{
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(core, &cores);
    std::ignore = sched_setaffinity(process, sizeof(cores), &cores);
}

} // namespace ACS::Load::ProcessProbe

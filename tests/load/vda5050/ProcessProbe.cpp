#include "ProcessProbe.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sched.h>
#include <sstream>
#include <stdexcept>
#include <string>
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
    constexpr int FIELDS_BEFORE = 11; ///< Between the name in parentheses, which may hold blanks, and utime.
    std::string text;
    std::ifstream file = OpenFile(process, "stat");
    std::getline(file, text);
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int i = 0; i < FIELDS_BEFORE; ++i)
    {
        fields >> skipped;
    }
    double user = 0.0;
    double system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
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

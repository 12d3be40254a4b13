#include "common/process/FileLimit.hpp"

#include <sys/resource.h>
#include <tuple>

namespace ACS::Apps
{

void RaiseFileLimit()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max)
    {
        limit.rlim_cur = limit.rlim_max;
        std::ignore = setrlimit(RLIMIT_NOFILE, &limit);
    }
}

} // namespace ACS::Apps

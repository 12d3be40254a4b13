#pragma once

#include <csignal>
#include <cstddef>
#include <sys/resource.h>

namespace ACS::Testing
{

/// During its lifetime no file of this process grows beyond this number of bytes, as on a full disk.
class FullDisk
{
    rlimit _before{};

public:
    explicit FullDisk(std::size_t bytes)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &_before);
        rlimit limit = _before;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
    }

    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

    ~FullDisk()
    {
        setrlimit(RLIMIT_FSIZE, &_before);
    }
};

} // namespace ACS::Testing

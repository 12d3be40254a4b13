#pragma once

#include "Catch.hpp"

#include <csignal>
#include <cstdint>
#include <sys/resource.h>

namespace ACS::Planning::Test
{

/// During its lifetime the system accepts no longer file.
class TightDisk
{
    rlimit _before{};

public:
    explicit TightDisk(std::uintmax_t room)
    {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &_before) == 0);
        const rlimit tight{room, _before.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &tight) == 0);
    }

    TightDisk(const TightDisk&) = delete;
    TightDisk& operator=(const TightDisk&) = delete;

    ~TightDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &_before);
        std::signal(SIGXFSZ, _handler);
    }

private:
    void (*_handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

} // namespace ACS::Planning::Test

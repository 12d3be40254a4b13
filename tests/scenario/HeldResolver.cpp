#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <string_view>
#include <unistd.h>

// Loaded into a program by LD_PRELOAD: a name server that does not answer while the pipe named by ACS_HELD_RESOLVER exists and
// has no writer. Then every name that ends with ".test" is 127.0.0.1. With ACS_RESOLVER_DELAY each answer takes this
// number of milliseconds, as if the first name server were dead.

extern "C"
{
    // NOLINTNEXTLINE(readability-identifier-naming,readability-inconsistent-declaration-parameter-name): the system's own
    int getaddrinfo(const char* host, const char* service, const addrinfo* hints, addrinfo** found)
    {
        const bool bName = host != nullptr && std::string_view(host).ends_with(".test");
        const char* const path =
            std::getenv("ACS_HELD_RESOLVER"); // NOLINT(concurrency-mt-unsafe): the environment never changes
        if (bName && path != nullptr)
        {
            // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
            const int gate = open(path, O_RDONLY | O_CLOEXEC); // waits for the writer
            if (gate >= 0)
            {
                close(gate);
            }
        }
        const char* const delay =
            std::getenv("ACS_RESOLVER_DELAY"); // NOLINT(concurrency-mt-unsafe): the environment never changes
        if (bName && delay != nullptr)
        {
            ::poll(nullptr, 0, static_cast<int>(std::strtol(delay, nullptr, 10)));
        }
        using Call = int (*)(const char*, const char*, const addrinfo*, addrinfo**);
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): that is how the system gives a function
        const auto resolve = reinterpret_cast<Call>(dlsym(RTLD_NEXT, "getaddrinfo"));
        return resolve(bName ? "127.0.0.1" : host, service, hints, found);
    }
}

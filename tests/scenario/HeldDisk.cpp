#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

// Loaded into acsd by LD_PRELOAD: a disk that hangs while the pipe named by ACS_HELD_DISK exists and has no writer.

namespace
{

int CallWhenFree(const char* name, int file)
{
    const char* const path =
        std::getenv("ACS_HELD_DISK"); // NOLINT(concurrency-mt-unsafe): the environment never changes
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
    const int gate = path == nullptr ? -1 : open(path, O_RDONLY | O_CLOEXEC); // waits for the writer
    if (gate >= 0)
    {
        close(gate);
    }
    using Call = int (*)(int);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): that is how the system gives a function
    return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name))(file);
}

} // namespace

extern "C"
{
    // NOLINTNEXTLINE(readability-identifier-naming,readability-inconsistent-declaration-parameter-name): the system's own
    int fsync(int file)
    {
        return CallWhenFree("fsync", file);
    }

    // NOLINTNEXTLINE(readability-identifier-naming,readability-inconsistent-declaration-parameter-name): the system's own
    int fdatasync(int file)
    {
        return CallWhenFree("fdatasync", file);
    }
}

#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

// Loaded into acsd by LD_PRELOAD: a disk that is full, for all files below the directory named by ACS_FULL_DISK, while the file
// with this name and the ending .full exists. If this file has a name of a function, only this function fails.

namespace
{

/// The function of the system with this name.
template <typename TCall>
TCall Find(const char* name)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): that is how the system gives a function
    return reinterpret_cast<TCall>(dlsym(RTLD_NEXT, name));
}

/// Whether the switch is on for the function.
bool HasNoSpace(const std::string& directory, std::string_view name)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
    const int file = open((directory + ".full").c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
    {
        return false;
    }
    std::string only(NAME_MAX, '\0');
    const ssize_t length = read(file, only.data(), only.size());
    close(file);
    only.resize(length < 0 ? 0 : static_cast<std::size_t>(length));
    return only.empty() || only == name;
}

bool IsFull(const char* name, int file)
{
    const int before = errno;
    const char* const directory =
        std::getenv("ACS_FULL_DISK"); // NOLINT(concurrency-mt-unsafe): the environment never changes
    bool bFull = directory != nullptr && HasNoSpace(directory, name);
    if (bFull)
    {
        std::string path(PATH_MAX, '\0');
        const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path.data(), path.size());
        path.resize(length < 0 ? 0 : static_cast<std::size_t>(length));
        bFull = std::string_view(path).starts_with(std::string(directory) + '/');
    }
    errno = bFull ? ENOSPC : before;
    return bFull;
}

/// Calls the function of the system, or fails with ENOSPC.
template <typename TResult, typename... TArguments>
TResult CallWithSpace(const char* name, int file, TArguments... arguments)
{
    using Call = TResult (*)(int, TArguments...);
    return IsFull(name, file) ? TResult{-1} : Find<Call>(name)(file, arguments...);
}

/// The same for a new length: a file can become shorter on a full disk.
template <typename TLength>
int Truncate(const char* name, int file, TLength length)
{
    struct stat status = {};
    const bool bShorter = fstat(file, &status) == 0 && length <= status.st_size;
    using Call = int (*)(int, TLength);
    return bShorter ? Find<Call>(name)(file, length) : CallWithSpace<int>(name, file, length);
}

} // namespace

// NOLINTBEGIN(readability-identifier-naming,readability-inconsistent-declaration-parameter-name): the system's own
extern "C"
{
    ssize_t write(int file, const void* data, std::size_t size)
    {
        return CallWithSpace<ssize_t>("write", file, data, size);
    }

    ssize_t writev(int file, const iovec* parts, int count)
    {
        return CallWithSpace<ssize_t>("writev", file, parts, count);
    }

    ssize_t pwrite(int file, const void* data, std::size_t size, off_t offset)
    {
        return CallWithSpace<ssize_t>("pwrite", file, data, size, offset);
    }

    ssize_t pwrite64(int file, const void* data, std::size_t size, off64_t offset)
    {
        return CallWithSpace<ssize_t>("pwrite64", file, data, size, offset);
    }

    int ftruncate(int file, off_t length) noexcept
    {
        return Truncate("ftruncate", file, length);
    }

    int ftruncate64(int file, off64_t length) noexcept
    {
        return Truncate("ftruncate64", file, length);
    }

    int fallocate(int file, int mode, off_t offset, off_t length)
    {
        return CallWithSpace<int>("fallocate", file, mode, offset, length);
    }

    int fallocate64(int file, int mode, off64_t offset, off64_t length)
    {
        return CallWithSpace<int>("fallocate64", file, mode, offset, length);
    }

    int posix_fallocate(int file, off_t offset, off_t length)
    {
        using Call = int (*)(int, off_t, off_t);
        return IsFull("posix_fallocate", file) ? ENOSPC : Find<Call>("posix_fallocate")(file, offset, length);
    }

    int posix_fallocate64(int file, off64_t offset, off64_t length)
    {
        using Call = int (*)(int, off64_t, off64_t);
        return IsFull("posix_fallocate64", file) ? ENOSPC : Find<Call>("posix_fallocate64")(file, offset, length);
    }

    int fsync(int file)
    {
        return CallWithSpace<int>("fsync", file);
    }

    int fdatasync(int file)
    {
        return CallWithSpace<int>("fdatasync", file);
    }
}
// NOLINTEND(readability-identifier-naming,readability-inconsistent-declaration-parameter-name)

#include "StoreLock.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace ACS::Planning
{

namespace
{

constexpr mode_t FILE_MODE = 0644;

} // namespace

StoreLock::StoreLock(int descriptor)
    : _descriptor(descriptor)
{
}

StoreLock::~StoreLock()
{
    if (_descriptor >= 0)
    {
        ::close(_descriptor);
    }
}

Core::Result<StoreLock> StoreLock::Acquire(const std::string& storePath)
{
    // Whatever it is called: by a link to the same file it is the same store.
    std::error_code unresolved;
    const std::filesystem::path resolved = std::filesystem::weakly_canonical(storePath, unresolved);
    const std::string path = (unresolved ? storePath : resolved.string()) + ".lock";
    const std::error_code code = make_error_code(EPlanningError::StoreFailed);
    StoreLock lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, FILE_MODE)); // NOLINT: the system's own signature
    if (lock._descriptor < 0)
    {
        return Core::Fail(code, path, "a file that can be created", std::generic_category().message(errno));
    }
    if (::flock(lock._descriptor, LOCK_EX | LOCK_NB) != 0)
    {
        const int reason = errno;
        return Core::Fail(
            code,
            storePath,
            "a store of this program alone; stop the other one, or choose another file",
            reason == EWOULDBLOCK ? "one that another program has open" : std::generic_category().message(reason));
    }
    return lock;
}

} // namespace ACS::Planning

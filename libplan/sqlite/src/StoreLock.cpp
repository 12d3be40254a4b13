#include "StoreLock.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace ACS::Planning
{

namespace
{

constexpr mode_t FILE_MODE = 0644;
constexpr std::string_view MARK = "open\n";

bool Exists(const std::string& path)
{
    std::error_code unreadable;
    return std::filesystem::exists(path, unreadable);
}

} // namespace

StoreLock::StoreLock(int descriptor)
    : _descriptor(descriptor)
{
}

StoreLock::~StoreLock()
{
    if (_descriptor < 0)
    {
        return;
    }
    if (!_logPath.empty() && !Exists(_logPath))
    {
        Mark(false);
    }
    ::close(_descriptor);
}

/// A mark that cannot be written only tells less.
void StoreLock::Mark(bool bOpen) const
{
    const bool bCut = ::ftruncate(_descriptor, 0) == 0;
    if (bCut && bOpen)
    {
        [[maybe_unused]] const ssize_t written = ::pwrite(_descriptor, MARK.data(), MARK.size(), 0);
    }
}

Core::Result<void> StoreLock::CheckLog(const std::string& storePath)
{
    const std::string lockPath = StoreFiles::Resolve(storePath) + ".lock";
    const std::string logPath = StoreFiles::GetLogPath(storePath);
    std::error_code unreadable;
    const bool bMarked = std::filesystem::file_size(lockPath, unreadable) > 0 && !unreadable;
    if (!bMarked || !Exists(storePath) || Exists(logPath))
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        storePath,
        fmt::format(
            "{} beside it, with what was stored last, as the program before did not close the store; put it back, restore both "
            "from a backup, or remove {} to go on with what the store itself has",
            logPath,
            lockPath),
        "no such file");
}

Core::Result<StoreLock> StoreLock::Acquire(const std::string& storePath)
{
    const std::string path = StoreFiles::Resolve(storePath) + ".lock";
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
    lock._logPath = StoreFiles::GetLogPath(storePath);
    return lock;
}

} // namespace ACS::Planning

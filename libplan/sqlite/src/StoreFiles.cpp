#include "StoreFiles.hpp"

#include "StoreFault.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Planning
{

namespace
{

std::string DescribeErrno(int reason)
{
    return std::generic_category().message(reason);
}

tl::unexpected<Core::Error> RefuseFile(const std::string& path, std::string expected, std::string found)
{
    return Refuse(EPlanningError::StoreFailed, path, std::move(expected), std::move(found));
}

std::string GetFolder(const std::string& path)
{
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// A folder in which the store's files can be made: it has more than one.
Core::Result<void> CheckFolder(const std::string& path)
{
    const std::string folder = GetFolder(path);
    struct stat status = {};
    if (::stat(folder.c_str(), &status) != 0)
    {
        return RefuseFile(
            path,
            fmt::format("a file in a folder that is there; make the folder {}, or give another path", folder),
            fmt::format("{}: {}", folder, DescribeErrno(errno)));
    }
    if (!S_ISDIR(status.st_mode))
    {
        return RefuseFile(path, "a file in a folder; give another path", fmt::format("{}, which is no folder", folder));
    }
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    {
        return RefuseFile(
            path,
            fmt::format(
                "a folder in which this user may make files, as the store has some beside it; correct the owner or the rights "
                "of {}",
                folder),
            fmt::format("{}: {}", folder, DescribeErrno(errno)));
    }
    return {};
}

/// A path may have any character; three of them part a URI.
std::string EscapeForUri(const std::string& path)
{
    std::string escaped;
    for (const char character : path)
    {
        const bool bParts = character == '%' || character == '?' || character == '#';
        escaped += bParts ? fmt::format("%{:02X}", static_cast<unsigned>(character)) : std::string(1, character);
    }
    return escaped;
}

} // namespace

StoreFiles::StoreFiles(std::string path, std::string logPath)
    : _path(std::move(path)),
      _logPath(std::move(logPath)),
      _store(FindOrNull(_path)),
      _log(FindOrNull(_logPath))
{
}

std::optional<StoreFileChange> StoreFiles::FindChangeOrNull() const
{
    if (FindOrNull(_path) != _store)
    {
        return MakeChange(_path, false);
    }
    return FindOrNull(_logPath) != _log ? std::optional(MakeChange(_logPath, true)) : std::nullopt;
}

Core::Result<void> StoreFiles::CheckUsable(const std::string& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
    {
        const int reason = errno;
        if (reason == ENOENT || reason == ENOTDIR)
        {
            return CheckFolder(path);
        }
        return RefuseFile(
            path,
            "a path that can be followed; correct it, or the rights on its way",
            DescribeErrno(reason));
    }
    if (S_ISDIR(status.st_mode))
    {
        return RefuseFile(path, "a file; give the path of one in that folder", "a folder");
    }
    if (!S_ISREG(status.st_mode))
    {
        return RefuseFile(path, "a regular file; give another path", "a device, a pipe or a socket");
    }
    if (::faccessat(AT_FDCWD, path.c_str(), R_OK | W_OK, AT_EACCESS) != 0)
    {
        return RefuseFile(
            path,
            "a file that this user may read and write; correct its owner or its rights",
            DescribeErrno(errno));
    }
    return CheckFolder(path);
}

Core::Result<void> StoreFiles::CheckLogHasStore(const std::string& path)
{
    struct stat status = {};
    const bool bStore = ::stat(path.c_str(), &status) == 0 && status.st_size > 0;
    const std::string log = GetLogPath(path);
    if (bStore || ::stat(log.c_str(), &status) != 0 || status.st_size == 0)
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        path,
        fmt::format(
            "the store to which {} belongs; put that file back, or move both away to begin with an empty one",
            log),
        "a log of a store, and no store");
}

std::string StoreFiles::Resolve(const std::string& path)
{
    std::error_code unresolved;
    const std::filesystem::path resolved = std::filesystem::weakly_canonical(path, unresolved);
    return unresolved ? path : resolved.string();
}

std::string StoreFiles::GetLogPath(const std::string& path)
{
    return Resolve(path) + "-wal";
}

bool StoreFiles::HasOnlyStore(const std::string& path)
{
    struct stat status = {};
    const bool bStore = ::stat(path.c_str(), &status) == 0 && status.st_size > 0;
    return bStore && ::stat(GetLogPath(path).c_str(), &status) != 0;
}

std::optional<std::string> StoreFiles::MakeUntouchedUriOrNull(const std::string& path)
{
    struct stat log = {};
    const bool bLog = ::stat(GetLogPath(path).c_str(), &log) == 0 && log.st_size > 0;
    return bLog ? std::nullopt : std::optional("file:" + EscapeForUri(path) + "?immutable=1");
}

bool StoreFiles::TrySynchronise(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC); // NOLINT: the system's own signature
    if (file < 0)
    {
        return false;
    }
    const bool bDone = ::fsync(file) == 0;
    const int reason = errno;
    ::close(file);
    errno = reason;
    return bDone;
}

bool StoreFiles::TrySynchroniseFolder(const std::string& path)
{
    return TrySynchronise(GetFolder(path));
}

std::optional<StoreFiles::Identity> StoreFiles::FindOrNull(const std::string& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
    {
        return std::nullopt;
    }
    return Identity{status.st_dev, status.st_ino};
}

StoreFileChange StoreFiles::MakeChange(const std::string& path, bool bOfLog)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0)
    {
        return {bOfLog, true, fmt::format("another file in the place of {}, which was open", path)};
    }
    const int reason = errno;
    return {
        bOfLog,
        false,
        reason == ENOENT ? fmt::format("{} removed or moved away while it was open", path)
                         : fmt::format("{} out of reach: {}", path, DescribeErrno(reason))};
}

} // namespace ACS::Planning

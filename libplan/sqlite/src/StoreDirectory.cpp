#include "StoreDirectory.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreGeneration.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr mode_t DIRECTORY_MODE = 0700;
constexpr mode_t RIGHTS_OF_OTHERS = 0077;

/// Checks that a missing directory can be created.
Core::Result<void> CheckParent(const std::string& path)
{
    const std::string parent = StoreFiles::GetParent(path);
    struct stat status = {};
    const bool bFound = ::stat(parent.c_str(), &status) == 0;
    const bool bMissing = !bFound || !S_ISDIR(status.st_mode);
    if (!bMissing && ::faccessat(AT_FDCWD, parent.c_str(), W_OK | X_OK, AT_EACCESS) == 0)
    {
        return {};
    }
    const int reason = bFound && bMissing ? ENOTDIR : errno;
    return Refuse(
        path,
        bMissing ? fmt::format("an existing parent directory; create the directory {}, or give another path", parent)
                 : fmt::format("permission to create the directory; correct the owner or the mode of {}", parent),
        fmt::format("{}: {}", parent, DescribeErrno(reason)));
}

Core::Result<void> CheckDatabaseFile(const std::string& database)
{
    struct stat status = {};
    const bool bFound = ::lstat(database.c_str(), &status) == 0;
    if (bFound && !S_ISREG(status.st_mode))
    {
        return Refuse(database, "a regular file; move it away", "a directory, link, device, pipe or socket");
    }
    for (const std::string& file : {database, GetGenerationPath(database)})
    {
        if (StoreFiles::IsThere(file) && ::faccessat(AT_FDCWD, file.c_str(), R_OK | W_OK, AT_EACCESS) != 0)
        {
            return Refuse(
                file,
                "a file that this user may read and write; correct its owner or its mode",
                DescribeErrno(errno));
        }
    }
    if (StoreFiles::IsThere(database + ".lock"))
    {
        return Refuse(
            database,
            fmt::format("a store directory; give {} itself as the directory: it is migrated to one", database),
            "a database of the former layout, with a .lock file beside it");
    }
    return {};
}

} // namespace

StoreDirectory::StoreDirectory(int descriptor)
    : _descriptor(descriptor)
{
}

StoreDirectory::~StoreDirectory()
{
    if (_descriptor >= 0)
    {
        ::close(_descriptor);
    }
}

Core::Result<StoreDirectory> StoreDirectory::Acquire(const std::string& path)
{
    if (::mkdir(path.c_str(), DIRECTORY_MODE) != 0 && errno != EEXIST)
    {
        return Refuse(
            path,
            "a directory that can be created; check its parent directory and its disk",
            DescribeErrno(errno));
    }
    static_cast<void>(StoreFiles::TrySynchroniseParent(path)); // not supported by every file system
    return Lock(path).and_then([&path](StoreDirectory locked) -> Core::Result<StoreDirectory> {
        if (!locked.IsAt(path))
        {
            return Refuse(
                path,
                "a directory that stays in place; start again",
                "another directory than before the lock");
        }
        return locked;
    });
}

Core::Result<StoreDirectory> StoreDirectory::Lock(const std::string& path)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's own signature
    StoreDirectory directory(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (directory._descriptor < 0 || ::flock(directory._descriptor, LOCK_EX | LOCK_NB) != 0)
    {
        const int reason = errno;
        return Refuse(
            reason == EWOULDBLOCK ? EPlanningError::StoreTaken : EPlanningError::StoreFailed,
            path,
            "a store that only this program uses; stop the other program, or give another directory",
            reason == EWOULDBLOCK ? "a lock of another program" : DescribeErrno(reason));
    }
    return directory;
}

bool StoreDirectory::IsAt(const std::string& path) const
{
    struct stat own = {};
    struct stat found = {};
    return _descriptor >= 0 && ::fstat(_descriptor, &own) == 0 && ::stat(path.c_str(), &found) == 0
        && own.st_dev == found.st_dev && own.st_ino == found.st_ino;
}

Core::Result<void> StoreDirectory::Check(const std::string& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
    {
        return CheckParent(path);
    }
    if (!S_ISDIR(status.st_mode))
    {
        const bool bFile = S_ISREG(status.st_mode);
        return Refuse(
            path,
            bFile
                ? "a directory; give that of the store (the next start of acsd migrates a database of the former layout)"
                : "a directory; give another path",
            bFile ? "a file" : "a device, pipe or socket");
    }
    if ((status.st_mode & RIGHTS_OF_OTHERS) != 0)
    {
        return Refuse(
            path,
            "a directory for this program only; give a new directory, or set its mode to 0700 (chmod 700)",
            fmt::format("mode {:04o}", status.st_mode & ~static_cast<mode_t>(S_IFMT)));
    }
    if (::faccessat(AT_FDCWD, path.c_str(), R_OK | W_OK | X_OK, AT_EACCESS) != 0)
    {
        return Refuse(
            path,
            "a directory in which this user may create files; correct its owner or its mode",
            DescribeErrno(errno));
    }
    return CheckDatabaseFile(GetDatabasePath(path));
}

std::string StoreDirectory::GetDatabasePath(const std::string& path)
{
    return path + "/acsd.db";
}

} // namespace ACS::Planning

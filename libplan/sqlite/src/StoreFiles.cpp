#include "StoreFiles.hpp"

#include "StoreFault.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Planning
{

namespace
{

tl::unexpected<Core::Error> RefuseWrite(const std::string& path, const std::string& reason)
{
    return Refuse(path, "a file that can be written; check its disk and free space", reason);
}

/// A path may have any character; three of them separate the parts of a URI.
std::string EscapeForURI(const std::string& path)
{
    std::string escaped;
    for (const char character : path)
    {
        const bool bSeparates = character == '%' || character == '?' || character == '#';
        escaped += bSeparates ? fmt::format("%{:02X}", static_cast<unsigned>(character)) : std::string(1, character);
    }
    return escaped;
}

} // namespace

StoreFiles::StoreFiles(std::string database)
    : _database(std::move(database)),
      _databaseFile(FindOrNull(_database)),
      _logFile(FindOrNull(GetLogPath(_database)))
{
}

std::optional<StoreFileChange> StoreFiles::FindChangeOrNull() const
{
    if (FindOrNull(_database) != _databaseFile)
    {
        return MakeChange(_database, false);
    }
    const std::string log = GetLogPath(_database);
    return FindOrNull(log) != _logFile ? std::optional(MakeChange(log, true)) : std::nullopt;
}

Core::Result<void> StoreFiles::CheckLogHasDatabase(const std::string& database)
{
    const std::string log = GetLogPath(database);
    if (HasContent(database) || !HasContent(log))
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        database,
        fmt::format(
            "the database to which {} belongs; put that file back, or move both away to start with an empty store",
            log),
        "a log without its database");
}

std::string StoreFiles::GetLogPath(const std::string& database)
{
    return database + "-wal";
}

std::string StoreFiles::GetParent(const std::string& path)
{
    const std::string parent = std::filesystem::path(path).parent_path().string();
    return parent.empty() ? "." : parent;
}

std::string StoreFiles::DescribeIdentity(const std::string& path)
{
    struct statx status = {};
    if (::statx(AT_FDCWD, path.c_str(), 0, STATX_INO | STATX_BTIME, &status) != 0)
    {
        return {};
    }
    const bool bTimed = (status.stx_mask & STATX_BTIME) != 0; // not every file system has it
    return bTimed ? fmt::format("{}-{}.{:09}", status.stx_ino, status.stx_btime.tv_sec, status.stx_btime.tv_nsec)
                  : fmt::format("{}", status.stx_ino);
}

bool StoreFiles::IsThere(const std::string& path)
{
    return FindOrNull(path).has_value();
}

bool StoreFiles::HasContent(const std::string& path)
{
    return GetSize(path) > 0;
}

std::uint64_t StoreFiles::GetSize(const std::string& path)
{
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::optional<std::string> StoreFiles::MakeImmutableUriOrNull(const std::string& database)
{
    return HasContent(GetLogPath(database)) ? std::nullopt
                                            : std::optional("file:" + EscapeForURI(database) + "?immutable=1");
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

bool StoreFiles::TrySynchroniseParent(const std::string& path)
{
    return TrySynchronise(GetParent(path));
}

Core::Result<void> StoreFiles::Rename(const std::string& from, const std::string& to)
{
    std::error_code failed;
    std::filesystem::rename(from, to, failed);
    if (!failed && !TrySynchroniseParent(to))
    {
        failed = std::error_code(errno, std::generic_category());
    }
    return failed ? Core::Result<void>(RefuseWrite(to, failed.message())) : Core::Result<void>();
}

Core::Result<void> StoreFiles::Write(const std::string& path, std::string_view text)
{
    const std::string part = path + ".part";
    errno = 0;
    if (!(std::ofstream(part, std::ios::binary) << text).flush() || !TrySynchronise(part))
    {
        return RefuseWrite(path, DescribeErrno(errno));
    }
    return Rename(part, path);
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
        return {bOfLog, true, fmt::format("{} replaced by another file while it was open", path)};
    }
    const int reason = errno;
    return {
        bOfLog,
        false,
        reason == ENOENT ? fmt::format("{} removed or moved away while it was open", path)
                         : fmt::format("{} cannot be reached: {}", path, DescribeErrno(reason))};
}

} // namespace ACS::Planning

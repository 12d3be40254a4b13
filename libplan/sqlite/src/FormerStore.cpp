#include "FormerStore.hpp"

#include "StoreDirectory.hpp"
#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreGeneration.hpp"
#include "StoreRescue.hpp"
#include "StoreSchema.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>
#include <SQLiteCpp/Database.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

namespace ACS::Planning
{

namespace
{

/// Name of the directory until it is complete and the former files are renamed.
std::string GetStagingPath(const std::string& path)
{
    return path + ".migrating";
}

std::string GetStagedDatabase(const std::string& path)
{
    return StoreDirectory::GetDatabasePath(GetStagingPath(path));
}

bool IsRegular(const std::string& path)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// If the path is a symbolic link, the files of the store are beside its target.
std::string ResolveLink(const std::string& path)
{
    std::error_code unresolved;
    if (!std::filesystem::is_symlink(path, unresolved))
    {
        return path;
    }
    const std::filesystem::path target = std::filesystem::weakly_canonical(path, unresolved);
    return unresolved ? path : target.string();
}

/// The database; else the copy that was made when the database was removed while it was open; else the staged database of an
/// interrupted migration, which is complete once the former database is renamed.
std::optional<std::string> FindSourceOrNull(const std::string& path)
{
    if (IsRegular(path))
    {
        return path;
    }
    for (std::string source : {GetRescuePath(path), GetStagedDatabase(path)})
    {
        if (!StoreFiles::IsThere(path) && IsRegular(source))
        {
            return source;
        }
    }
    return std::nullopt;
}

/// In the former layout, `.lock` had "log " and a number, or "open", while changes were only in the log. The number was
/// written to the log too, so that a database without its log has a lower one.
Core::Result<void> CheckFormerLog(SQLite::Database& database, const std::string& path, bool bLogFound)
{
    constexpr std::string_view NUMBER_PREFIX = "log ";
    const std::string lockPath = path + ".lock";
    std::ifstream lock(lockPath);
    std::string line;
    if (!std::getline(lock, line) || line.empty())
    {
        return {};
    }
    std::int64_t expected = 0;
    const bool bNumbered = line.starts_with(NUMBER_PREFIX)
        && std::from_chars(line.data() + NUMBER_PREFIX.size(), line.data() + line.size(), expected).ec == std::errc();
    const char* numberQuery = "SELECT coalesce(max(CAST(value AS INTEGER)), 0) FROM settings WHERE name = 'log_number'";
    const bool bComplete = bNumbered ? database.execAndGet(numberQuery).getInt64() >= expected : bLogFound;
    if (bComplete)
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        path,
        fmt::format(
            "the log {}, which has the latest changes because the store was not closed; put it back, or, to continue without "
            "them, such as with a restored backup, remove {}",
            StoreFiles::GetLogPath(path),
            lockPath),
        "a database that was not closed, without its log");
}

/// Opens the former database read-only and checks it.
Core::Result<std::unique_ptr<SQLite::Database>> OpenFormer(
    const std::string& path,
    const std::string& source,
    StoreOrigin& origin)
{
    const bool bLogFound = StoreFiles::HasContent(StoreFiles::GetLogPath(source));
    const std::optional<std::string> uri = StoreFiles::MakeImmutableUriOrNull(source);
    std::unique_ptr<SQLite::Database> database;
    const auto checkDatabase = [&]() -> Core::Result<StoreOrigin> {
        try
        {
            const int flags = SQLite::OPEN_READONLY | SQLite::OPEN_URI;
            database = std::make_unique<SQLite::Database>(uri.value_or(source), flags);
            RestrictSchema(*database);
            return CheckSchema(*database, source, bLogFound).and_then([&](StoreOrigin found) {
                return (source == path ? CheckFormerLog(*database, path, bLogFound) : Core::Result<void>())
                    .map([found] { return found; });
            });
        }
        catch (const SQLite::Exception& exception)
        {
            return RefuseFor(exception, source, "opening", 0);
        }
    };
    return CheckRescued(path)
        .and_then([&source] { return StoreFiles::CheckLogHasDatabase(source); })
        .and_then(checkDatabase)
        .and_then([&](StoreOrigin found) -> Core::Result<std::unique_ptr<SQLite::Database>> {
            if (found.foundVersion >= FIRST_DIRECTORY_VERSION && source == path)
            {
                return Refuse(
                    path,
                    "a store directory; give the directory of this database, or move it into one, as acsd.db",
                    "a database of such a directory");
            }
            origin = found;
            origin.bMigrated = true;
            origin.bRescued = source == GetRescuePath(path);
            return std::move(database);
        });
}

/// Creates the directory with a copy of the former database, durable on return.
Core::Result<void> Stage(const std::string& path, const std::string& source, StoreOrigin& origin)
{
    const Core::Result<std::unique_ptr<SQLite::Database>> former = OpenFormer(path, source, origin);
    if (!former.has_value())
    {
        return tl::unexpected(former.error());
    }
    std::error_code ignored;
    std::filesystem::remove_all(GetStagingPath(path), ignored); // of a migration that was interrupted
    const Core::Result<StoreDirectory> directory = StoreDirectory::Acquire(GetStagingPath(path));
    if (!directory.has_value())
    {
        return tl::unexpected(directory.error());
    }
    return CopyDatabase(**former, GetStagedDatabase(path)).and_then([&] {
        return ListGeneration(**former, GetStagedDatabase(path));
    });
}

/// A log of the former layout whose database is missing is refused too.
Core::Result<void> CheckNoFormerLog(const std::string& path)
{
    return StoreFiles::IsThere(path) ? Core::Result<void>() : StoreFiles::CheckLogHasDatabase(path);
}

} // namespace

Core::Result<std::optional<StoreOrigin>> InspectFormerStore(const std::string& givenPath)
{
    const std::string path = ResolveLink(givenPath);
    const std::optional<std::string> source = FindSourceOrNull(path);
    std::optional<StoreOrigin> origin;
    return (source.has_value() ? OpenFormer(path, *source, origin.emplace()).map([](const auto&) {})
                               : CheckNoFormerLog(path))
        .map([&origin] { return origin; });
}

Core::Result<std::optional<StoreOrigin>> MigrateFormerStore(const std::string& givenPath)
{
    const std::string path = ResolveLink(givenPath);
    const std::optional<std::string> source = FindSourceOrNull(path);
    if (!source.has_value())
    {
        return CheckNoFormerLog(path).map([] { return std::optional<StoreOrigin>(); });
    }
    const std::string lockPath = path + ".lock";
    const Core::Result<StoreDirectory> formerLock =
        StoreFiles::IsThere(lockPath) ? StoreDirectory::Lock(lockPath) : StoreDirectory();
    if (!formerLock.has_value())
    {
        return tl::unexpected(formerLock.error());
    }
    StoreOrigin origin;
    const bool bStaged = *source == GetStagedDatabase(path);
    Core::Result<void> done = bStaged ? Core::Result<void>() : Stage(path, *source, origin);
    for (const char* ending : {"", ".rescued", "-wal", "-shm", ".lock"})
    {
        if (done.has_value() && StoreFiles::IsThere(path + ending))
        {
            done = StoreFiles::Rename(path + ending, path + ".former" + ending);
        }
    }
    if (done.has_value())
    {
        done = StoreFiles::Rename(GetStagingPath(path), path);
    }
    return done.map([&origin] { return std::optional(origin); });
}

} // namespace ACS::Planning

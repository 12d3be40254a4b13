#include "StoreDirectory.hpp"
#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreGeneration.hpp"
#include "StoreRescue.hpp"
#include "StoreSchema.hpp"
#include <acs/plan_sqlite/StoreBackup.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/Database.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr int LOCK_WAIT_MILLISECONDS = 5'000;

Core::Result<void> CheckSource(SQLite::Database& database, const std::string& path)
{
    RestrictSchema(database);
    return CheckSchema(database, path, StoreFiles::HasContent(StoreFiles::GetLogPath(path)))
        .and_then([&path](const StoreOrigin& origin) -> Core::Result<void> {
            return origin.bNew
                ? Core::Result<void>(Refuse(path, "a plan store; give another path", "an empty database"))
                : Core::Result<void>();
        });
}

/// All pages in one step: a program that writes meanwhile would restart a copy in several steps.
Core::Result<void> CopyPages(
    SQLite::Database& from,
    const std::string& source,
    SQLite::Database& to,
    const std::string& target)
{
    try
    {
        SQLite::Backup backup(to, "main", from, "main");
        const int code = backup.executeStep(-1);
        return code == SQLITE_DONE
            ? Core::Result<void>()
            : Core::Result<void>(Refuse(source, "a database that can be copied; try again", "a lock"));
    }
    catch (const SQLite::Exception& exception)
    {
        const int code = exception.getErrorCode(); // of either database
        const bool bOfSource = code == SQLITE_IOERR_READ || code == SQLITE_IOERR_SHORT_READ || code == SQLITE_CORRUPT
            || code == SQLITE_NOTADB;
        return RefuseFor(exception, bOfSource ? source : target, "copying", errno);
    }
}

/// SQLite does not state why it cannot create a file.
Core::Result<void> CreateFile(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
    if (file < 0)
    {
        return Refuse(
            path,
            "a file that can be created; correct its path, or the rights on its folder",
            DescribeErrno(errno));
    }
    ::close(file);
    return {};
}

/// One file without a log.
Core::Result<void> WriteCopy(SQLite::Database& from, const std::string& source, const std::string& target)
{
    if (Core::Result<void> created = CreateFile(target); !created.has_value())
    {
        return created;
    }
    try
    {
        SQLite::Database to(target, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        RestrictSchema(to);
        if (Core::Result<void> copied = CopyPages(from, source, to, target); !copied.has_value())
        {
            return copied;
        }
        to.exec("PRAGMA journal_mode = DELETE");
        if (to.execAndGet("PRAGMA user_version").getInt() >= FIRST_DIRECTORY_VERSION)
        {
            MarkAsBackup(to);
        }
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, target, "writing the copy", errno);
    }
    return StoreFiles::TrySynchronise(target)
        ? Core::Result<void>()
        : Core::Result<void>(Refuse(target, "a copy that can be written", DescribeErrno(errno)));
}

/// No program writes to a source that is not shared.
Core::Result<void> CopyDatabase(const std::string& source, bool bShared, const std::string& target)
{
    try
    {
        const std::optional<std::string> uri = bShared ? std::nullopt : StoreFiles::MakeImmutableUriOrNull(source);
        const int flags = SQLite::OPEN_READONLY | (uri.has_value() ? SQLite::OPEN_URI : 0);
        SQLite::Database from(uri.value_or(source), flags, LOCK_WAIT_MILLISECONDS);
        return CheckSource(from, source).and_then([&] { return WriteCopy(from, source, target); });
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, source, "reading", errno);
    }
}

/// A copy that is not complete, with what SQLite has written beside it.
void RemoveCopy(const std::string& path)
{
    for (const char* const suffix : {"", "-wal", "-shm", "-journal"})
    {
        std::error_code ignored;
        std::filesystem::remove(path + suffix, ignored);
    }
}

/// After a failure nothing of the copy remains: it may need all the space of its disk.
Core::Result<void> CopyAsBackup(const std::string& source, bool bShared, const std::string& target)
{
    RemoveCopy(target); // of an attempt that was killed
    return CopyDatabase(source, bShared, target).map_error([&target](Core::Error error) {
        RemoveCopy(target);
        return error;
    });
}

/// Keeps a file under another name too.
Core::Result<void> Keep(const std::string& path, const std::string& name)
{
    std::error_code failed;
    if (StoreFiles::IsThere(path))
    {
        std::filesystem::create_hard_link(path, name, failed);
    }
    return failed ? Core::Result<void>(Refuse(name, "a name for the previous database", failed.message()))
                  : Core::Result<void>();
}

/// There is a database at any moment: a start without one would create an empty store.
Core::Result<void> ReplaceDatabase(const std::string& database, const std::string& copy)
{
    const std::string previous = database + ".previous";
    return Keep(database, previous)
        .and_then([&] { return Keep(StoreFiles::GetLogPath(database), StoreFiles::GetLogPath(previous)); })
        .and_then([&] {
            std::error_code ignored;
            std::filesystem::remove(StoreFiles::GetLogPath(database), ignored);
            std::filesystem::remove(database + "-shm", ignored);
            return StoreFiles::Rename(copy, database);
        });
}

Core::Result<void> CheckRoom(const std::string& path, const char* remedy)
{
    return StoreFiles::IsThere(path) ? Core::Result<void>(Refuse(path, remedy, "a file of this name"))
                                     : Core::Result<void>();
}

Core::Result<void> CheckExists(const std::string& path, const char* expected)
{
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 ? Core::Result<void>()
                                              : Core::Result<void>(Refuse(path, expected, DescribeErrno(errno)));
}

} // namespace

Core::Result<void> BackUpStore(const std::string& directory, const std::string& file)
{
    const std::string database = StoreDirectory::GetDatabasePath(directory);
    const std::string part = file + ".part";
    return CheckRoom(file, "a new file; give another path, or move this file away")
        .and_then([&] { return StoreDirectory::Check(directory); })
        .and_then([&] { return StoreFiles::CheckLogHasDatabase(database); })
        .and_then([&] { return CheckExists(database, "a store; give the directory of one"); })
        .and_then([&] {
            // Locked for the time of the copy, unless a program has it open.
            const Core::Result<StoreDirectory> locked = StoreDirectory::Lock(directory);
            return CopyAsBackup(database, !locked.has_value(), part);
        })
        .and_then([&] { return StoreFiles::Rename(part, file); });
}

Core::Result<void> RestoreStore(const std::string& directory, const std::string& file)
{
    const std::string database = StoreDirectory::GetDatabasePath(directory);
    const std::string part = database + ".part";
    StoreDirectory locked;
    return CheckExists(file, "an existing backup; correct its path")
        .and_then([&] { return StoreDirectory::Check(directory); })
        .and_then([&] { return StoreDirectory::Acquire(directory); })
        .map([&locked](StoreDirectory acquired) { locked = std::move(acquired); })
        .and_then([&] { return CheckRoom(database + ".previous", "no database of an earlier restore; move it away"); })
        .and_then([&] { return CheckRoom(GetRescuePath(database), "no copy of a removed database; move it away"); })
        .and_then([&] { return CopyAsBackup(file, false, part); })
        .map_error([&file](Core::Error error) {
            if (error.code == EPlanningError::StoreCorrupt && error.path == file)
            {
                error.expected = "an undamaged backup; give another one";
            }
            return error;
        })
        .and_then([&] { return ReplaceDatabase(database, part); });
}

} // namespace ACS::Planning

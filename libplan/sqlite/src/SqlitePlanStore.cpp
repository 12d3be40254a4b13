#include "FormerStore.hpp"
#include "SqliteDatabase.hpp"
#include "StoreDirectory.hpp"
#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreGeneration.hpp"
#include "StoreRescue.hpp"
#include "StoreSchema.hpp"
#include <acs/plan/SqlPlanTables.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr int BUSY_MILLISECONDS = 1'000;

/// A log that is larger has not been merged by SQLite, which does so with each commit from 1,000 pages (4 MiB) on.
constexpr std::uint64_t LARGE_LOG_BYTES = 8ULL * 1024 * 1024;

/// Sets whether SQLite keeps the log when the database is closed, instead of merging and deleting it.
void KeepLog(SQLite::Database& database, bool bKept)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the library's own signature
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, bKept ? 1 : 0, nullptr);
}

/// The names of the files beside the directory are made from its path without a trailing slash.
std::string RemoveTrailingSlashes(std::string path)
{
    while (path.size() > 1 && path.back() == '/')
    {
        path.pop_back();
    }
    return path;
}

/// Merges the log into the database, so that the next commit begins a new log. Returns why it could not, or an empty text.
std::string MergeLog(SQLite::Database& database, const std::string& path)
{
    const int code =
        sqlite3_wal_checkpoint_v2(database.getHandle(), "main", SQLITE_CHECKPOINT_RESTART, nullptr, nullptr);
    if (code == SQLITE_OK)
    {
        return {};
    }
    return code == SQLITE_BUSY
        ? fmt::format("another program reads the database. Find it with fuser -v {} and end it", path)
        : fmt::format("{}. Check the disk", sqlite3_errmsg(database.getHandle()));
}

} // namespace

class SqlitePlanStore::Impl
{
    StoreDirectory _directory;   ///< Declared first: the lock is released after the database is closed.
    StoreDirectory _placeholder; ///< The directory that has taken its place, locked too; else empty.
    std::string _path;
    bool _bLogFound;
    SQLite::Database _database;
    SqliteDatabase _tables;
    StoreFiles _files;
    StoreOrigin _origin;
    bool _bOpen = false;    ///< The database is marked as open (StoreGeneration.hpp).
    bool _bRescued = false; ///< The database file is missing or replaced, and its content was copied.

public:
    /// Throws SQLite::Exception, as all functions of this class except the destructor.
    Impl(StoreDirectory directory, const std::string& path, const std::string& file, int flags)
        : _directory(std::move(directory)),
          _path(path),
          _bLogFound(StoreFiles::HasContent(StoreFiles::GetLogPath(path))),
          _database(file, flags, BUSY_MILLISECONDS),
          _tables(_database, _path)
    {
        KeepLog(_database, _bLogFound); // a database that is refused is left unchanged
        RestrictSchema(_database);
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    ~Impl()
    {
        try
        {
            Close();
        }
        catch (const std::exception&)
        {
            // The log is kept. The next start reads it.
        }
    }

    [[nodiscard]] const std::string& GetPath() const noexcept
    {
        return _path;
    }

    [[nodiscard]] StoreOrigin& GetOrigin() noexcept
    {
        return _origin;
    }

    /// Checks the database before anything is written. A database that is accepted may be of another generation.
    [[nodiscard]] Core::Result<void> Check(bool bAccepted)
    {
        return CheckSchema(_database, _path, _bLogFound).and_then([this, bAccepted](const StoreOrigin& origin) {
            _origin = origin;
            return origin.bNew || bAccepted ? Core::Result<void>() : CheckGeneration(_database, _path, _bLogFound);
        });
    }

    /// The reason to hold the work is stored before the generation: without it the database is not accepted.
    [[nodiscard]] Core::Result<void> Prepare(const std::optional<std::string>& holdReasonOrNull)
    {
        _database.exec("PRAGMA synchronous = FULL");
        _database.exec("PRAGMA foreign_keys = ON");
        // A new database gets its schema before its log: if it cannot be written, nothing is left of it.
        MigrateSchema(_database, _origin.foundVersion);
        _database.exec("PRAGMA journal_mode = WAL");
        // A log that could not be merged for a while gets small again.
        _database.exec(fmt::format("PRAGMA journal_size_limit = {}", LARGE_LOG_BYTES));
        // A missing table is reported now, not at the first change.
        const SQLite::Statement allTables(
            _database,
            "SELECT 1 FROM plans, reports, carriers, alarms, settings, robot_works, maintenance");
        if (holdReasonOrNull.has_value())
        {
            SQLite::Statement hold(_database, "INSERT OR REPLACE INTO settings VALUES ('hold_reason', ?)");
            hold.bind(1, *holdReasonOrNull);
            hold.exec();
        }
        Core::Result<void> begun = Begin();
        _files = StoreFiles(_path);
        return begun;
    }

    /// SQLite writes to a removed file without an error, and the changes are lost when it is closed.
    [[nodiscard]] Core::Result<void> CheckFiles()
    {
        if (Core::Result<void> kept = KeepPath(); !kept.has_value())
        {
            return kept;
        }
        std::optional<StoreFileChange> change = _files.FindChangeOrNull();
        if (change.has_value())
        {
            std::string remedy = change->bOfLog ? SaveLog() : Rescue(change->bReplaced);
            return Refuse(_path, std::move(remedy), std::move(change->found));
        }
        if (std::exchange(_bRescued, false))
        {
            RemoveRescued(_path);
        }
        return _bOpen ? Core::Result<void>() : Begin();
    }

    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch)
    {
        Core::Result<void> stored = _tables.Run("BEGIN", {});
        for (auto change = batch.changes.begin(); stored.has_value() && change != batch.changes.end(); ++change)
        {
            stored = WriteChange(_tables, *change);
        }
        stored = stored.and_then([this] { return Commit(); });
        if (!stored.has_value())
        {
            std::ignore = _tables.Run("ROLLBACK", {}); // fails if SQLite has rolled back by itself
        }
        return stored;
    }

    [[nodiscard]] StoreLog CheckLog()
    {
        std::error_code ignored;
        StoreLog log;
        log.path = _path;
        log.bytes = StoreFiles::GetSize(StoreFiles::GetLogPath(_path));
        log.freeBytes = std::filesystem::space(StoreFiles::GetParent(_path), ignored).available;
        if (log.bytes > LARGE_LOG_BYTES)
        {
            sqlite3_busy_timeout(_database.getHandle(), 0);
            log.blockReason = MergeLog(_database, _path);
            sqlite3_busy_timeout(_database.getHandle(), BUSY_MILLISECONDS);
        }
        return log;
    }

    [[nodiscard]] Core::Result<StoredState> Load()
    {
        return ReadStoredState(
            _tables,
            {_path, std::string(RESTORE_IT), "SELECT seq FROM sqlite_sequence WHERE name = 'reports'"});
    }

private:
    /// A commit that has been written to the log and could not be synchronised stays there until the next one overwrites it. A
    /// write that fails leaves no complete commit.
    [[nodiscard]] Core::Result<void> Commit()
    {
        return _tables.Run("COMMIT", {}).map_error([this](Core::Error error) {
            const int code = _database.getExtendedErrorCode();
            if (code != SQLITE_FULL && code != SQLITE_IOERR_WRITE)
            {
                error.code = make_error_code(EPlanningError::StoreOutcomeUnknown);
            }
            return error;
        });
    }

    /// A directory that replaces the one that is open is locked too, so that no other program starts on the path.
    [[nodiscard]] Core::Result<void> KeepPath()
    {
        const std::string path = StoreFiles::GetParent(_path);
        if (_directory.IsAt(path) || _placeholder.IsAt(path) || !StoreFiles::IsThere(path))
        {
            return {};
        }
        Core::Result<StoreDirectory> locked = StoreDirectory::Lock(path);
        if (!locked.has_value() && locked.error().code == EPlanningError::StoreTaken)
        {
            return tl::unexpected(std::move(locked.error()));
        }
        _placeholder = locked.has_value() ? std::move(*locked) : StoreDirectory();
        return {};
    }

    [[nodiscard]] Core::Result<void> Begin()
    {
        KeepLog(_database, true); // first, because it must stay in effect if the rest fails
        Core::Result<void> begun = BeginGeneration(_database, _path);
        _bOpen = begun.has_value();
        return begun;
    }

    void Close()
    {
        if (_bOpen)
        {
            EndGeneration(_database);
            KeepLog(_database, false);
            _bOpen = false;
        }
    }

    /// Merges the content of a missing or replaced log into the database. Returns the remedy for the error text.
    [[nodiscard]] std::string SaveLog()
    {
        Close();
        return TryCheckpoint(_database)
            ? "the log that was opened; restart: everything stored is in the database, and nothing is stored until then"
            : "the log that was opened; close each other program that reads the database: the changes stored last cannot be "
              "merged into the database until then";
    }

    /// Copies the content of a missing or replaced database. Returns the remedy for the error text.
    [[nodiscard]] std::string Rescue(bool bReplaced)
    {
        const std::string copy = GetRescuePath(_path);
        const Core::Result<void> copied = _bRescued ? Core::Result<void>() : CopyDatabase(_database, copy);
        _bRescued = copied.has_value();
        return _bRescued
            ? fmt::format(
                "the file that was opened; put it back, or {}restart: everything stored is in {}, which the next start restores",
                bReplaced ? "move the other file away and " : "",
                copy)
            : fmt::format(
                "the file that was opened; put it back before this program ends, or all plans are lost: they cannot be copied: "
                "{}",
                Core::Describe(copied.error()));
    }
};

SqlitePlanStore::SqlitePlanStore(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

SqlitePlanStore::~SqlitePlanStore() = default;

Core::Result<std::unique_ptr<SqlitePlanStore>> SqlitePlanStore::Open(const std::string& directory)
{
    return OpenAs(directory, std::nullopt);
}

Core::Result<std::unique_ptr<SqlitePlanStore>> SqlitePlanStore::Accept(
    const std::string& directory,
    const std::string& holdReason)
{
    const std::string database = StoreDirectory::GetDatabasePath(RemoveTrailingSlashes(directory));
    if (!StoreFiles::HasContent(database))
    {
        return Refuse(database, "a database to accept; give the directory of a store", "none");
    }
    return OpenAs(directory, holdReason);
}

Core::Result<std::unique_ptr<SqlitePlanStore>> SqlitePlanStore::OpenAs(
    const std::string& directory,
    const std::optional<std::string>& holdReasonOrNull)
{
    const std::string path = RemoveTrailingSlashes(directory);
    const std::string database = StoreDirectory::GetDatabasePath(path);
    StoreOrigin origin;
    StoreDirectory locked;
    const Core::Result<void> usable = MigrateFormerStore(path)
                                          .and_then([&](const std::optional<StoreOrigin>& formerOrNull) {
                                              origin.bMigrated = formerOrNull.has_value();
                                              origin.bRescued = formerOrNull.has_value() && formerOrNull->bRescued;
                                              return StoreDirectory::Check(path);
                                          })
                                          .and_then([&] { return StoreDirectory::Acquire(path); })
                                          .and_then([&](StoreDirectory acquired) {
                                              locked = std::move(acquired);
                                              return RestoreRescued(database);
                                          })
                                          .and_then([&](bool bRestored) {
                                              origin.bRescued = origin.bRescued || bRestored;
                                              return StoreFiles::CheckLogHasDatabase(database);
                                          });
    if (!usable.has_value())
    {
        return tl::unexpected(usable.error());
    }
    try
    {
        auto impl =
            std::make_unique<Impl>(std::move(locked), database, database, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        const Core::Result<void> opened =
            impl->Check(holdReasonOrNull.has_value()).and_then([&] { return impl->Prepare(holdReasonOrNull); });
        if (!opened.has_value())
        {
            return tl::unexpected(opened.error());
        }
        impl->GetOrigin().bMigrated = origin.bMigrated;
        impl->GetOrigin().bRescued = origin.bRescued;
        return std::unique_ptr<SqlitePlanStore>(new SqlitePlanStore(std::move(impl)));
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, database, "opening", 0);
    }
}

Core::Result<StoreOrigin> SqlitePlanStore::Inspect(const std::string& directory)
{
    return InspectAs(directory, [](Impl& /*impl*/) { return Core::Result<void>(); });
}

Core::Result<StoredState> SqlitePlanStore::InspectState(const std::string& directory)
{
    StoredState state;
    return InspectAs(
               directory,
               [&state](Impl& impl) {
                   const bool bReadable = impl.GetOrigin().foundVersion == impl.GetOrigin().version;
                   return bReadable ? impl.Load().map([&state](StoredState loaded) { state = std::move(loaded); })
                                    : Core::Result<void>();
               })
        .map([&state](const StoreOrigin& /*origin*/) { return std::move(state); });
}

Core::Result<StoreOrigin> SqlitePlanStore::InspectAs(
    const std::string& directory,
    const std::function<Core::Result<void>(Impl&)>& read)
{
    const std::string path = RemoveTrailingSlashes(directory);
    const std::string database = StoreDirectory::GetDatabasePath(path);
    const Core::Result<std::optional<StoreOrigin>> former = InspectFormerStore(path);
    if (!former.has_value() || former->has_value())
    {
        return former.map([](const std::optional<StoreOrigin>& origin) { return *origin; });
    }
    const bool bRescued = StoreFiles::IsThere(GetRescuePath(database));
    const Core::Result<void> usable =
        StoreDirectory::Check(path).and_then([&] { return CheckRescued(database); }).and_then([&] {
            return bRescued ? Core::Result<void>() : StoreFiles::CheckLogHasDatabase(database);
        });
    if (!usable.has_value())
    {
        return tl::unexpected(usable.error());
    }
    if (!StoreFiles::IsThere(database))
    {
        return StoreOrigin{!bRescued, bRescued, 0, GetNewestSchemaVersion()};
    }
    try
    {
        const std::optional<std::string> uri = StoreFiles::MakeImmutableUriOrNull(database);
        const int flags = SQLite::OPEN_READONLY | (uri.has_value() ? SQLite::OPEN_URI : 0);
        Impl impl(StoreDirectory(), database, uri.value_or(database), flags);
        return impl.Check(false).and_then([&] { return read(impl); }).map([&impl] { return impl.GetOrigin(); });
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, database, "opening", 0);
    }
}

const StoreOrigin& SqlitePlanStore::GetOrigin() const noexcept
{
    return _impl->GetOrigin();
}

Core::Result<StoredState> SqlitePlanStore::Load()
{
    return _impl->Load();
}

Core::Result<void> SqlitePlanStore::Append(const StoreBatch& batch)
{
    return Check().and_then([&] { return _impl->Append(batch); });
}

Core::Result<void> SqlitePlanStore::Check()
{
    try
    {
        return _impl->CheckFiles();
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _impl->GetPath(), "saving what was in a lost log", 0);
    }
}

StoreLog SqlitePlanStore::CheckLog()
{
    return _impl->CheckLog();
}

} // namespace ACS::Planning

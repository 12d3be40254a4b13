#include "StoreGeneration.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreLogCheck.hpp"
#include "StoreSchema.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace ACS::Planning
{

namespace
{

/// Rows of the table settings.
constexpr const char* GENERATION = "generation";
constexpr const char* OPEN = "open";

std::string ReadSetting(SQLite::Database& database, const char* name)
{
    SQLite::Statement query(database, "SELECT value FROM settings WHERE name = ?");
    query.bind(1, name);
    return query.executeStep() ? query.getColumn(0).getString() : std::string();
}

void WriteSetting(SQLite::Database& database, const char* name, const std::string& value)
{
    SQLite::Statement statement(database, "INSERT OR REPLACE INTO settings VALUES (?, ?)");
    statement.bind(1, name);
    statement.bind(2, value);
    statement.exec();
}

/// In the file, of a database that was never open in a directory.
constexpr const char* NO_GENERATION = "-";
/// Of a backup, in the database.
constexpr const char* BACKUP_GENERATION = "backup";

enum class EListing : std::uint8_t
{
    NoFile,    ///< The directory has no generation file.
    Missing,   ///< The file does not list the generation.
    OtherFile, ///< The file lists it for another database file.
    Listed
};

std::string ReadGeneration(SQLite::Database& database)
{
    const bool bHasOne = database.execAndGet("PRAGMA user_version").getInt() >= FIRST_DIRECTORY_VERSION;
    const std::string generation = bHasOne ? ReadSetting(database, GENERATION) : std::string();
    return generation.empty() ? NO_GENERATION : generation;
}

std::string MakeLine(const std::string& generation, const std::string& path)
{
    return fmt::format("{} {}\n", generation, StoreFiles::DescribeIdentity(path));
}

/// Each line of the file is a generation and the identity of its database file, which earlier versions did not write. While a
/// start replaces the generation, the file has the previous one too.
EListing FindListing(const std::string& file, const std::string& generation, const std::string& path)
{
    if (!StoreFiles::IsThere(file))
    {
        return EListing::NoFile;
    }
    std::ifstream in(file);
    std::string line;
    EListing listing = EListing::Missing;
    while (std::getline(in, line))
    {
        std::istringstream parts(line);
        std::string listed;
        std::string identity;
        parts >> listed >> identity;
        if (listed == generation)
        {
            const bool bSame = identity.empty() || identity == StoreFiles::DescribeIdentity(path);
            listing = bSame ? EListing::Listed : EListing::OtherFile;
        }
    }
    return listing;
}

std::string_view Describe(EListing listing, bool bLogDamaged)
{
    if (listing == EListing::Listed && bLogDamaged)
    {
        return "a database that was not closed, with a damaged log";
    }
    switch (listing)
    {
        case EListing::NoFile:
            return "a copied or restored database, without the file generation";
        case EListing::OtherFile:
            return "a copy of the database that was used last";
        case EListing::Missing:
            return "a database of another generation";
        case EListing::Listed:
        default:
            return "a database that was not closed, without its log";
    }
}

} // namespace

std::string GetGenerationPath(const std::string& path)
{
    return StoreFiles::GetParent(path) + "/generation";
}

Core::Result<void> CheckGeneration(SQLite::Database& database, const std::string& path, bool bLogFound)
{
    const std::string generation = ReadGeneration(database);
    const EListing listing = FindListing(GetGenerationPath(path), generation, path);
    const bool bNeverOpen = generation == NO_GENERATION;
    const bool bClosed = bNeverOpen || ReadSetting(database, OPEN) != "1";
    const bool bLogDamaged = bLogFound && !bClosed && IsLogDamaged(StoreFiles::GetLogPath(path));
    const bool bComplete = bClosed || (bLogFound && !bLogDamaged);
    // The first start of a new store was killed before it had a generation.
    const bool bUnused = bNeverOpen && database.execAndGet("SELECT count(*) FROM plans").getInt64() == 0;
    if (bUnused || (listing == EListing::Listed && bComplete))
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        path,
        fmt::format(
            "the database that was used last, with its log {}; put these files back; or, to continue with the database as it "
            "is (a restored backup, a copy, or one into which another program has merged the log), run acsd store accept {}: the "
            "TSC is then paused",
            StoreFiles::GetLogPath(path),
            StoreFiles::GetParent(path)),
        std::string(Describe(listing, bLogDamaged)));
}

Core::Result<void> BeginGeneration(SQLite::Database& database, const std::string& path)
{
    const std::string file = GetGenerationPath(path);
    const std::string generation = database.execAndGet("SELECT lower(hex(randomblob(16)))").getString();
    Core::Result<void> written =
        StoreFiles::Write(file, MakeLine(generation, path) + MakeLine(ReadGeneration(database), path));
    if (!written.has_value())
    {
        return written;
    }
    SQLite::Transaction transaction(database);
    WriteSetting(database, GENERATION, generation);
    WriteSetting(database, OPEN, "1");
    transaction.commit();
    // While another program reads, the database file keeps the previous generation: without its log it is refused then.
    static_cast<void>(TryCheckpoint(database));
    return ListGeneration(database, path);
}

void EndGeneration(SQLite::Database& database)
{
    WriteSetting(database, OPEN, "0");
}

Core::Result<void> ListGeneration(SQLite::Database& database, const std::string& path)
{
    return StoreFiles::Write(GetGenerationPath(path), MakeLine(ReadGeneration(database), path));
}

void MarkAsBackup(SQLite::Database& database)
{
    SQLite::Transaction transaction(database);
    WriteSetting(database, GENERATION, BACKUP_GENERATION);
    WriteSetting(database, OPEN, "0");
    transaction.commit();
}

bool TryCheckpoint(SQLite::Database& database)
{
    int pages = 0;
    int merged = 0;
    const int code =
        sqlite3_wal_checkpoint_v2(database.getHandle(), "main", SQLITE_CHECKPOINT_PASSIVE, &pages, &merged);
    return code == SQLITE_OK && pages == merged;
}

} // namespace ACS::Planning

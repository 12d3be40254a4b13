#include "StoreGeneration.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreSchema.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace ACS::Planning
{

namespace
{

/// Rows of the table settings.
constexpr const char* GENERATION = "generation";
constexpr const char* OPEN = "open";

std::string GetGenerationPath(const std::string& path)
{
    return StoreFiles::GetParent(path) + "/generation";
}

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

/// Each line of the file is a generation. While a start replaces the generation, the file has the previous one too.
bool IsListed(const std::string& file, const std::string& generation)
{
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line))
    {
        if (line == generation)
        {
            return true;
        }
    }
    return false;
}

} // namespace

Core::Result<void> CheckGeneration(SQLite::Database& database, const std::string& path, bool bLogFound)
{
    const std::string file = GetGenerationPath(path);
    if (!StoreFiles::IsThere(file))
    {
        return {};
    }
    const bool bHasGeneration = database.execAndGet("PRAGMA user_version").getInt() >= FIRST_DIRECTORY_VERSION;
    const bool bListed = IsListed(file, bHasGeneration ? ReadSetting(database, GENERATION) : std::string());
    const bool bComplete = bLogFound || !bHasGeneration || ReadSetting(database, OPEN) != "1";
    if (bListed && bComplete)
    {
        return {};
    }
    return Refuse(
        EPlanningError::StoreCorrupt,
        path,
        fmt::format(
            "the database that was used last, with its log {}; put these files back; or, to continue with the database as it "
            "is (a restored backup, or one into which another program has merged the log), remove {}",
            StoreFiles::GetLogPath(path),
            file),
        bListed ? "a database that was not closed, without its log" : "a database of another generation");
}

Core::Result<void> BeginGeneration(SQLite::Database& database, const std::string& path)
{
    const std::string file = GetGenerationPath(path);
    const std::string generation = database.execAndGet("SELECT lower(hex(randomblob(16)))").getString();
    Core::Result<void> written =
        StoreFiles::Write(file, fmt::format("{}\n{}\n", generation, ReadSetting(database, GENERATION)));
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
    return StoreFiles::Write(file, generation + "\n");
}

void EndGeneration(SQLite::Database& database)
{
    WriteSetting(database, OPEN, "0");
}

void ForgetGeneration(const std::string& path)
{
    std::error_code ignored;
    std::filesystem::remove(GetGenerationPath(path), ignored);
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

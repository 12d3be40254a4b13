#include "StoreSchema.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/Transaction.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Planning
{

namespace
{

/// What PRAGMA application_id of the databases returns: "ACSP".
constexpr int STORE_APPLICATION_ID = 0x41435350;

/// Entry n migrates version n to n + 1. A released entry must not be changed; append a new one.
constexpr std::array MIGRATIONS{
    // Columns have the values for searching and sorting, JSON texts the rest.
    "CREATE TABLE plans (sequence INTEGER PRIMARY KEY, plan_id TEXT NOT NULL UNIQUE, accepted_at INTEGER NOT NULL,"
    "  plan TEXT NOT NULL, state TEXT NOT NULL, progress TEXT NOT NULL);"
    "CREATE INDEX plans_by_state ON plans (state);"
    "CREATE TABLE reports (sequence INTEGER PRIMARY KEY AUTOINCREMENT, transaction_id TEXT NOT NULL UNIQUE,"
    "  time INTEGER NOT NULL, report TEXT NOT NULL);"
    "CREATE TABLE carriers (robot_id TEXT PRIMARY KEY, carriers TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE alarms (robot_id TEXT NOT NULL, error_code TEXT NOT NULL, plan_id TEXT NOT NULL,"
    "  job_id TEXT NOT NULL, alarm TEXT NOT NULL, PRIMARY KEY (robot_id, error_code, plan_id, job_id)) WITHOUT ROWID;",
    // Single values by name.
    "CREATE TABLE settings (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;",
    // The request that submitted a plan, the last commands of each robot, and the robots in maintenance.
    "ALTER TABLE plans ADD COLUMN transaction_id TEXT NOT NULL DEFAULT '';"
    "CREATE TABLE robot_works (robot_id TEXT PRIMARY KEY, work TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE maintenance (robot_id TEXT PRIMARY KEY) WITHOUT ROWID;",
    // The generation of a store directory replaces the numbers of logs.
    "DELETE FROM settings WHERE name = 'log_number';",
    // Nodes, edges and stations that an operator has blocked, in the order of the sequence.
    "CREATE TABLE blocks (sequence INTEGER PRIMARY KEY, kind TEXT NOT NULL, id TEXT NOT NULL, block TEXT NOT NULL,"
    "  UNIQUE (kind, id));",
    // Commands of operators that were accepted, which their senders may repeat. Few: deleted by age and number.
    "CREATE TABLE receipts (sequence INTEGER PRIMARY KEY, owner TEXT NOT NULL, key TEXT NOT NULL, answer TEXT NOT NULL,"
    "  time INTEGER NOT NULL);",
};

} // namespace

int GetNewestSchemaVersion() noexcept
{
    return static_cast<int>(MIGRATIONS.size());
}

Core::Result<StoreOrigin> CheckSchema(SQLite::Database& database, const std::string& path, bool bLogFound)
{
    const auto refuseAsCorrupt = [&path](std::string_view expected, std::string found) {
        return Refuse(
            EPlanningError::StoreCorrupt,
            path,
            fmt::format("{}; {}", expected, RESTORE_IT),
            std::move(found));
    };
    const int version = database.execAndGet("PRAGMA user_version").getInt();
    const int applicationID = database.execAndGet("PRAGMA application_id").getInt();
    const int tables = database.execAndGet("SELECT count(*) FROM sqlite_master").getInt();
    const bool bEmpty = version == 0 && applicationID == 0 && tables == 0;
    if (!bEmpty && applicationID != STORE_APPLICATION_ID)
    {
        return Refuse(
            EPlanningError::StoreCorrupt,
            path,
            "a plan store; give another path",
            "a database of another program");
    }
    if (bEmpty && !bLogFound && StoreFiles::HasContent(path))
    {
        return refuseAsCorrupt("a plan store, or no file", "a database without any table, and without a log");
    }
    if (!bEmpty && version <= 0)
    {
        return refuseAsCorrupt("an undamaged plan store", fmt::format("the schema version {}", version));
    }
    if (version > GetNewestSchemaVersion())
    {
        return Refuse(
            EPlanningError::StoreTooNew,
            path,
            fmt::format(
                "a schema up to version {}; start the newer program that wrote it, or restore a backup made before the upgrade",
                GetNewestSchemaVersion()),
            fmt::format("version {}", version));
    }
    std::string verdict = database.execAndGet("PRAGMA quick_check(1)").getString();
    if (verdict != "ok")
    {
        return refuseAsCorrupt("an undamaged plan store", std::move(verdict));
    }
    return StoreOrigin{bEmpty, false, version, GetNewestSchemaVersion()};
}

void RestrictSchema(SQLite::Database& database)
{
    // NOLINTBEGIN(cppcoreguidelines-pro-type-vararg): the library's own signature
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    // NOLINTEND(cppcoreguidelines-pro-type-vararg)
}

void MigrateSchema(SQLite::Database& database, int fromVersion)
{
    for (auto version = static_cast<std::size_t>(fromVersion); version < MIGRATIONS.size(); ++version)
    {
        SQLite::Transaction transaction(database);
        database.exec(MIGRATIONS[version]);
        database.exec(fmt::format("PRAGMA application_id = {}", STORE_APPLICATION_ID));
        database.exec(fmt::format("PRAGMA user_version = {}", version + 1));
        transaction.commit();
    }
}

} // namespace ACS::Planning

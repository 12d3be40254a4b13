#include "SchemaMigrations.hpp"

#include <fmt/format.h>
#include <SQLiteCpp/Transaction.h>

#include <array>
#include <cstddef>
#include <string>

namespace ACS::Planning
{

namespace
{

/// Step n leads from version n to n + 1. Never changed once released: append.
constexpr std::array MIGRATIONS{
    // Columns hold what is searched and sorted by, JSON texts the rest.
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
    // The request that brought a plan, what each robot was told last, and robots out of service.
    "ALTER TABLE plans ADD COLUMN transaction_id TEXT NOT NULL DEFAULT '';"
    "CREATE TABLE robot_works (robot_id TEXT PRIMARY KEY, work TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE maintenance (robot_id TEXT PRIMARY KEY) WITHOUT ROWID;",
};

} // namespace

int GetNewestSchemaVersion() noexcept
{
    return static_cast<int>(MIGRATIONS.size());
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

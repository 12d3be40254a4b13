#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/StoreOrigin.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

/// The first schema of a store that is a directory.
inline constexpr int FIRST_DIRECTORY_VERSION = 4;

/// The schema that this version reads and writes.
[[nodiscard]] int GetNewestSchemaVersion() noexcept;

/// Checks, without writing, that an open database is a plan store, is undamaged and has a known version.
/// EPlanningError::StoreCorrupt, StoreTooNew; throws SQLite::Exception.
[[nodiscard]] Core::Result<StoreOrigin> CheckSchema(
    SQLite::Database& database,
    const std::string& path,
    bool bLogFound);

/// Restricts what the schema of a file that others may have written can do: no statement changes the schema tables or the file
/// directly, and no trigger or view calls functions or virtual tables with side effects. For each opened database.
void RestrictSchema(SQLite::Database& database);

/// Brings the schema from its version to the newest, one transaction per version. Throws SQLite::Exception.
void MigrateSchema(SQLite::Database& database, int fromVersion);

} // namespace ACS::Planning

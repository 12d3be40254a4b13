#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan_sqlite/StoreOrigin.hpp>

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

/// Brings the schema from its version to the newest, one transaction per version. Throws SQLite::Exception.
void MigrateSchema(SQLite::Database& database, int fromVersion);

} // namespace ACS::Planning

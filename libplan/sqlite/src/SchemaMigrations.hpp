#pragma once

#include <SQLiteCpp/Database.h>

namespace ACS::Planning
{

/// What PRAGMA application_id of our files says: "ACSP".
inline constexpr int STORE_APPLICATION_ID = 0x41435350;

/// The schema that this version reads and writes.
[[nodiscard]] int GetNewestSchemaVersion() noexcept;

/// Brings the schema from its version to the newest, one transaction per version. Throws what SQLiteCpp throws.
void MigrateSchema(SQLite::Database& database, int fromVersion);

} // namespace ACS::Planning

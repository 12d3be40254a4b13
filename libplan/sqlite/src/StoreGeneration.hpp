#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

// Each start gives the database a random generation, stored in the database and, with the identity of the database file, in a
// file beside it. With the flag `open` in the database, a start detects that the database was restored, copied or replaced, or
// that its log is missing (decision 7).

/// The file beside the database.
[[nodiscard]] std::string GetGenerationPath(const std::string& path);

/// Checks that the database is the one that was used last in its directory, and that its log is not missing.
/// EPlanningError::StoreCorrupt.
[[nodiscard]] Core::Result<void> CheckGeneration(SQLite::Database& database, const std::string& path, bool bLogFound);

/// Stores a new generation and marks the database as open. EPlanningError::StoreFailed; throws SQLite::Exception.
[[nodiscard]] Core::Result<void> BeginGeneration(SQLite::Database& database, const std::string& path);

/// Marks the database as closed: its log may be merged and deleted. Throws SQLite::Exception.
void EndGeneration(SQLite::Database& database);

/// Lists the database as the one that was used last in its directory; a generation file lists no other one then.
/// EPlanningError::StoreFailed; throws SQLite::Exception.
[[nodiscard]] Core::Result<void> ListGeneration(SQLite::Database& database, const std::string& path);

/// Marks a database as a backup: closed, and of a generation that no file lists. Throws SQLite::Exception.
void MarkAsBackup(SQLite::Database& database);

/// Merges the log into the database. False on an error, or while another program reads an older state.
[[nodiscard]] bool TryCheckpoint(SQLite::Database& database);

} // namespace ACS::Planning

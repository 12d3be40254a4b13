#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

// Each start gives the database a random generation, stored in the database and in a file beside it. With the flag `open`
// in the database, a start detects that the database was replaced or that its log is missing (decision 7).

/// Checks that the database is the one that was used last in its directory, and that its log is not missing. Accepts any
/// database if the directory has no generation file. EPlanningError::StoreCorrupt.
[[nodiscard]] Core::Result<void> CheckGeneration(SQLite::Database& database, const std::string& path, bool bLogFound);

/// Stores a new generation and marks the database as open. EPlanningError::StoreFailed; throws SQLite::Exception.
[[nodiscard]] Core::Result<void> BeginGeneration(SQLite::Database& database, const std::string& path);

/// Marks the database as closed: its log may be merged and deleted. Throws SQLite::Exception.
void EndGeneration(SQLite::Database& database);

/// Deletes the generation file: the next check accepts any database. For a database that is created or restored.
void ForgetGeneration(const std::string& path);

/// Merges the log into the database. False on an error, or while another program reads an older state.
[[nodiscard]] bool TryCheckpoint(SQLite::Database& database);

} // namespace ACS::Planning

#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

// Each start gives the database a random generation, stored in the database and in a file beside it. With the flag `open`
// in the database, a start detects that the database was replaced or that its log is missing (decision 7).

/// Whether the database is the one that was used last in its directory, complete with its log. Any database is accepted
/// where no file has the generation. EPlanningError::StoreCorrupt.
[[nodiscard]] Core::Result<void> CheckGeneration(SQLite::Database& database, const std::string& path, bool bLogFound);

/// Stores a new generation and marks the database as open. EPlanningError::StoreFailed; throws SQLite::Exception.
[[nodiscard]] Core::Result<void> BeginGeneration(SQLite::Database& database, const std::string& path);

/// Marks the database as closed: its log may be merged and deleted. Throws SQLite::Exception.
void EndGeneration(SQLite::Database& database);

/// For a database that is created or restored: whatever is found next is accepted.
void ForgetGeneration(const std::string& path);

/// Merges the log into the database. False while another program still reads an older state, or on an error.
[[nodiscard]] bool TryCheckpoint(SQLite::Database& database);

} // namespace ACS::Planning

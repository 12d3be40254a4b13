#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

/// "acsd.db.rescued": the copy of a database whose file was removed while it is open. Its content would be lost when the
/// program ends. The next start restores it.
[[nodiscard]] std::string GetRescuePath(const std::string& database);

/// Copies all that a database holds to a file, on disk and complete on return. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> CopyDatabase(SQLite::Database& database, const std::string& target);

/// The file is back: the copy is not needed any more.
void RemoveRescued(const std::string& database);

/// Fails if there are both a copy and a database: only a person can decide between them. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> CheckRescued(const std::string& database);

/// Before the store is opened: restores the copy if there is one. Returns whether it did. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<bool> RestoreRescued(const std::string& database);

} // namespace ACS::Planning

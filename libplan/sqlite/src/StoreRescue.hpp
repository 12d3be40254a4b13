#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

/// "acsd.db.rescued": the copy of a database whose file was removed while it was open, because its content is lost when the
/// program ends. The next start restores the copy.
[[nodiscard]] std::string GetRescuePath(const std::string& database);

/// Copies the content of a database to a file, durable on return. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> CopyDatabase(SQLite::Database& database, const std::string& target);

/// Deletes the copy, because the removed file is back.
void RemoveRescued(const std::string& database);

/// Fails if there are a copy and a database, because only the operator can decide between them. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> CheckRescued(const std::string& database);

/// Restores the copy if there is one; called before the database is opened. True if a copy was restored.
/// EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<bool> RestoreRescued(const std::string& database);

} // namespace ACS::Planning

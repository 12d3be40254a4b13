#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <string>

namespace ACS::Planning
{

/// Copies the database of a store to a new file, with SQLite's backup API: also while a program has the store open. The file has
/// one moment of the store, with what was in the log, and is durable on return. Errors: EPlanningError::StoreFailed (the file
/// exists or cannot be written), StoreCorrupt, StoreTooNew.
[[nodiscard]] ACS_API Core::Result<void> BackUpStore(const std::string& directory, const std::string& file);

/// Makes a copy of the file the database of the store. The present database is kept as `acsd.db.previous`, with its log. The
/// next SqlitePlanStore::Open refuses the store until it is accepted. Errors: EPlanningError::StoreTaken (a program has the store
/// open), StoreFailed, StoreCorrupt, StoreTooNew; the store is unchanged then.
[[nodiscard]] ACS_API Core::Result<void> RestoreStore(const std::string& directory, const std::string& file);

} // namespace ACS::Planning

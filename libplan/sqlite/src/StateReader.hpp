#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

/// Reads the whole content of a database of the newest schema. EPlanningError::StoreCorrupt; throws SQLite::Exception.
[[nodiscard]] Core::Result<StoredState> ReadState(SQLite::Database& database, const std::string& path);

} // namespace ACS::Planning

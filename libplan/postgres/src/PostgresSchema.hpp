#pragma once

#include "PostgresConnection.hpp"
#include <acs/core/Result.hpp>

#include <string>

namespace ACS::Planning
{

/// The version that this program writes.
[[nodiscard]] int GetNewestPostgresSchema() noexcept;

/// Reads the version of the schema acsd; 0: it does not exist. Errors: StoreTooNew, StoreCorrupt (the schema of another program, a
/// database without UTF-8), those of the connection.
[[nodiscard]] Core::Result<int> ReadPostgresSchema(PostgresConnection& connection, const std::string& name);

/// Creates the schema, or migrates it from this version. Several processes may do so at the same time.
[[nodiscard]] Core::Result<void> MigratePostgresSchema(PostgresConnection& connection, int fromVersion);

} // namespace ACS::Planning

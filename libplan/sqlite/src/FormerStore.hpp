#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/StoreOrigin.hpp>

#include <optional>
#include <string>

namespace ACS::Planning
{

// The former layout of a store: the path is that of the database, with `-wal`, `-shm`, `.lock` and `.rescued` beside it.

/// Checks a store of the former layout without changing it. Errors: those with which the migration would fail. nullopt if there
/// is no such store.
[[nodiscard]] Core::Result<std::optional<StoreOrigin>> InspectFormerStore(const std::string& path);

/// Replaces a store of the former layout by a directory with the same path and content. The former files are kept with
/// `.former` in their names. A migration that was interrupted is completed. nullopt if there is no such store. Errors as of
/// SqlitePlanStore::Open.
[[nodiscard]] Core::Result<std::optional<StoreOrigin>> MigrateFormerStore(const std::string& path);

} // namespace ACS::Planning

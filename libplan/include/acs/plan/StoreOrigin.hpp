#pragma once

namespace ACS::Planning
{

/// The state in which a store was found when it was opened or inspected.
struct StoreOrigin
{
    bool bNew = false;      ///< There was no database, or an empty one.
    bool bRescued = false;  ///< The database had been removed while open; it is restored from the copy made then.
    int foundVersion = 0;   ///< Schema version found; 0 for a new store.
    int version = 0;        ///< Schema version after opening.
    bool bMigrated = false; ///< The store had the former layout and was migrated to a directory.

    bool operator==(const StoreOrigin&) const = default;
};

} // namespace ACS::Planning

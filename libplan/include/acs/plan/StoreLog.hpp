#pragma once

#include <cstdint>
#include <string>

namespace ACS::Planning
{

/// The write-ahead log of a store, as measured by IPlanStore::CheckLog. All changes are written to it first and merged into the
/// database later. While it cannot be merged it grows, until the disk is full.
struct StoreLog
{
    std::string path;            ///< Of the database, as the operator finds it.
    std::uint64_t bytes = 0;     ///< Size of the log.
    std::uint64_t freeBytes = 0; ///< What is left on its file system.
    std::string
        blockReason; ///< Why a large log could not be merged, with the remedy; empty: it was merged, or is small.

    bool operator==(const StoreLog&) const = default;
};

} // namespace ACS::Planning

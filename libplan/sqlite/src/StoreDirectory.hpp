#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <utility>

namespace ACS::Planning
{

/// The directory of a store, locked while this object exists: two engines on one store would execute each plan twice. The
/// directory itself is locked (flock), because the system releases such a lock even if the program crashes.
class StoreDirectory
{
    int _descriptor = -1;

    explicit StoreDirectory(int descriptor);

public:
    StoreDirectory() = default;
    StoreDirectory(const StoreDirectory&) = delete;
    StoreDirectory& operator=(const StoreDirectory&) = delete;

    StoreDirectory(StoreDirectory&& other) noexcept
        : _descriptor(std::exchange(other._descriptor, -1))
    {
    }

    StoreDirectory& operator=(StoreDirectory&& other) noexcept
    {
        std::swap(_descriptor, other._descriptor);
        return *this;
    }

    ~StoreDirectory();

    /// Creates the directory if it is missing, and locks it. EPlanningError::StoreFailed, StoreTaken.
    [[nodiscard]] static Core::Result<StoreDirectory> Acquire(const std::string& path);

    /// Locks an existing directory or file. EPlanningError::StoreFailed; StoreTaken if another program has locked it.
    [[nodiscard]] static Core::Result<StoreDirectory> Lock(const std::string& path);

    /// Whether the path leads to this directory.
    [[nodiscard]] bool IsAt(const std::string& path) const;

    /// Checks that the directory can be used or created, and that its database, if there is one, can be opened.
    /// EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<void> Check(const std::string& path);

    [[nodiscard]] static std::string GetDatabasePath(const std::string& path);
};

} // namespace ACS::Planning

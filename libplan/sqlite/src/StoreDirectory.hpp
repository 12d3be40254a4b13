#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <utility>

namespace ACS::Planning
{

/// The directory that a store owns, locked: two engines on one store would execute each plan twice. The lock is on the
/// directory itself (flock), so there is no lock file, and the system releases it however the program ends.
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

    /// Creates the directory if it is missing, and locks it. EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<StoreDirectory> Acquire(const std::string& path);

    /// Locks an existing directory or file. EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<StoreDirectory> Lock(const std::string& path);

    /// Whether the directory can be used or created, and its database if there is one. EPlanningError::StoreFailed.
    [[nodiscard]] static Core::Result<void> Check(const std::string& path);

    [[nodiscard]] static std::string GetDatabasePath(const std::string& path);
};

} // namespace ACS::Planning

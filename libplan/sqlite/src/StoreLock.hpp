#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <utility>

namespace ACS::Planning
{

/// Keeps a second program from the same store: two engines on one file would do every plan twice. A file beside the
/// store, which stays: the system lifts its lock when this program ends, however it ends. Readers are not kept out.
class StoreLock
{
    int _descriptor = -1;

    explicit StoreLock(int descriptor);

public:
    StoreLock() = default;
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

    StoreLock(StoreLock&& other) noexcept
        : _descriptor(std::exchange(other._descriptor, -1))
    {
    }

    StoreLock& operator=(StoreLock&& other) noexcept
    {
        std::swap(_descriptor, other._descriptor);
        return *this;
    }

    ~StoreLock();

    /// EPlanningError::StoreFailed where another holds it, or the file cannot be made.
    [[nodiscard]] static Core::Result<StoreLock> Acquire(const std::string& storePath);
};

} // namespace ACS::Planning

#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace ACS::Planning
{

/// What the next start has to find, or something that was stored is missing.
struct StoreMark
{
    std::int64_t number = 0; ///< Of the log that was begun last: at least this one.
    bool bNeedsLog = false;  ///< The log's file, which was being folded.
};

/// Keeps a second program from the same store: two engines on one file would do every plan twice. A file beside the
/// store, which stays: the system lifts its lock when this program ends, however it ends. Readers are not kept out.
/// While something is stored that is in the log only, a mark is in that file.
class StoreLock
{
    int _descriptor = -1;
    std::string _storePath;

    StoreLock(int descriptor, std::string storePath);

public:
    StoreLock() = default;
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

    StoreLock(StoreLock&& other) noexcept
        : _descriptor(std::exchange(other._descriptor, -1)),
          _storePath(std::exchange(other._storePath, {}))
    {
    }

    StoreLock& operator=(StoreLock&& other) noexcept
    {
        std::swap(_descriptor, other._descriptor);
        std::swap(_storePath, other._storePath);
        return *this;
    }

    ~StoreLock();

    /// EPlanningError::StoreFailed where another holds it, or the file cannot be made.
    [[nodiscard]] static Core::Result<StoreLock> Acquire(const std::string& storePath);

    /// On disk when it returns. EPlanningError::StoreFailed where it cannot be written.
    [[nodiscard]] Core::Result<void> Mark(const StoreMark& mark) const;

    /// All is in the store itself. A mark that stays only asks for more.
    void Unmark() const;

    [[nodiscard]] static std::optional<StoreMark> ReadMarkOrNull(const std::string& storePath);

    /// Beside the store.
    [[nodiscard]] static std::string GetPath(const std::string& storePath);
};

} // namespace ACS::Planning

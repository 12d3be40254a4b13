#pragma once

#include <acs/core/Result.hpp>

#include <string>
#include <utility>

namespace ACS::Planning
{

/// Keeps a second program from the same store: two engines on one file would do every plan twice. A file beside the
/// store, which stays: the system lifts its lock when this program ends, however it ends. Readers are not kept out.
/// The file has a mark in it while the store is open, so that one whose log got lost after a crash is told apart from one
/// that was closed and has none.
class StoreLock
{
    int _descriptor = -1;
    std::string _logPath; ///< Of the write-ahead log; empty where another program has the lock.

    explicit StoreLock(int descriptor);

public:
    StoreLock() = default;
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

    StoreLock(StoreLock&& other) noexcept
        : _descriptor(std::exchange(other._descriptor, -1)),
          _logPath(std::exchange(other._logPath, {}))
    {
    }

    StoreLock& operator=(StoreLock&& other) noexcept
    {
        std::swap(_descriptor, other._descriptor);
        std::swap(_logPath, other._logPath);
        return *this;
    }

    /// Takes the mark away where the store has no log any more.
    ~StoreLock();

    /// EPlanningError::StoreFailed where another holds it, or the file cannot be made.
    [[nodiscard]] static Core::Result<StoreLock> Acquire(const std::string& storePath);

    /// The store has a log from now on, or none that matters.
    void Mark(bool bOpen) const;

    /// Before the store is opened. EPlanningError::StoreCorrupt where it was not closed and its log is not there: what was
    /// stored last is missing in it.
    [[nodiscard]] static Core::Result<void> CheckLog(const std::string& storePath);
};

} // namespace ACS::Planning

#pragma once

#include <acs/core/Result.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Sim
{

/// A file of lines to which several processes append, each with its own object of this class. A line is complete once its line
/// end is written: an incomplete line of a killed process is not read, and the next Append truncates it.
class WorldJournal
{
public:
    static constexpr std::uint64_t MAX_BYTES = 256U * 1024U * 1024U;
    static constexpr std::size_t MAX_LINE = 64U * 1024U;

    /// Maximum time that Acquire waits.
    static constexpr std::chrono::seconds LOCK_TIMEOUT{2};
    /// The same after a failure; longer than a working writer needs.
    static constexpr std::chrono::milliseconds MISSED_LOCK_TIMEOUT{50};

    /// The lock of all writers, held while this object exists. The system releases it even if the process crashes.
    class Lock
    {
        int _descriptor;

    public:
        /// The descriptor must have the lock.
        explicit Lock(int descriptor);
        Lock(const Lock&) = delete;
        Lock& operator=(const Lock&) = delete;

        Lock(Lock&& other) noexcept
            : _descriptor(std::exchange(other._descriptor, -1))
        {
        }

        Lock& operator=(Lock&&) = delete;
        ~Lock();
    };

    using LineReader = std::function<Core::Result<void>(std::string_view line)>;

private:
    std::string _path;
    int _descriptor = -1;
    std::uint64_t _offset = 0; ///< Offset of the first unread line.
    std::uint64_t _line = 0;   ///< Number of lines read.
    bool _bLockMissed = false; ///< The last Acquire failed.

    WorldJournal(std::string path, int descriptor);

public:
    WorldJournal(const WorldJournal&) = delete;
    WorldJournal& operator=(const WorldJournal&) = delete;

    WorldJournal(WorldJournal&& other) noexcept
        : _path(std::exchange(other._path, {})),
          _descriptor(std::exchange(other._descriptor, -1)),
          _offset(other._offset),
          _line(other._line),
          _bLockMissed(other._bLockMissed)
    {
    }

    WorldJournal& operator=(WorldJournal&&) = delete;
    ~WorldJournal();

    /// Opens the file, or creates it. All errors are EWorldError::JournalFailed, with path and line.
    [[nodiscard]] static Core::Result<WorldJournal> Open(const std::string& path);

    /// Waits up to LOCK_TIMEOUT for other writers, which have the lock only while they read new lines and append one. After a
    /// failure the next call waits up to MISSED_LOCK_TIMEOUT, so that the event loop of the caller is blocked only once.
    [[nodiscard]] Core::Result<Lock> Acquire();

    /// Passes the complete lines since the last call to the reader. Ends at an error of the reader; the next call passes that line
    /// again.
    [[nodiscard]] Core::Result<void> ReadNewLines(const LineReader& read);

    /// Appends a line; ReadNewLines then passes it too. Call it with the lock, after ReadNewLines.
    [[nodiscard]] Core::Result<void> Append(std::string line) const;

private:
    [[nodiscard]] Core::Result<std::uint64_t> GetSize() const;
    [[nodiscard]] Core::Result<void> ReadLines(std::string& text, const LineReader& read);
    [[nodiscard]] tl::unexpected<Core::Error> FailForErrno(std::string_view what) const;
};

} // namespace ACS::Sim

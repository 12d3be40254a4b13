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

/// A file of lines to which several processes append, each with its own object of this class. A line counts once its end is
/// written: what a killed process left of a line is not read, and the next Append cuts it off.
class WorldJournal
{
public:
    static constexpr std::uint64_t MAX_BYTES = 256U * 1024U * 1024U;
    static constexpr std::size_t MAX_LINE = 64U * 1024U;

    /// Maximum time that Acquire waits.
    static constexpr std::chrono::seconds LOCK_TIMEOUT{2};
    /// The same after a failure: enough for a writer that does its work.
    static constexpr std::chrono::milliseconds MISSED_LOCK_TIMEOUT{50};

    /// The lock of all writers, held while it exists. The system lifts it when the process ends, however it ends.
    class Lock
    {
        int _descriptor;

    public:
        /// Of a descriptor that has the lock.
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
    std::uint64_t _offset = 0; ///< Of the first line that is not read yet.
    std::uint64_t _line = 0;   ///< Lines that are read.
    bool _bLockMissed = false; ///< By the last Acquire.

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

    /// Created when missing. All errors are EWorldError::JournalFailed, with path and line.
    [[nodiscard]] static Core::Result<WorldJournal> Open(const std::string& path);

    /// Waits up to LOCK_TIMEOUT for other writers, each of which holds the lock only while it reads the news and appends a
    /// line. After a failure the next call waits up to MISSED_LOCK_TIMEOUT, so that a caller's event loop is blocked only once.
    [[nodiscard]] Core::Result<Lock> Acquire();

    /// Hands over the complete lines since the last call. An error of the reader ends it: that line is read again next time.
    [[nodiscard]] Core::Result<void> ReadNews(const LineReader& read);

    /// With the lock held, after ReadNews. The line is not read by this.
    [[nodiscard]] Core::Result<void> Append(std::string line) const;

private:
    [[nodiscard]] Core::Result<std::uint64_t> GetSize() const;
    [[nodiscard]] Core::Result<void> ReadLines(std::string& text, const LineReader& read);
    [[nodiscard]] tl::unexpected<Core::Error> FailForErrno(std::string_view what) const;
};

} // namespace ACS::Sim

#pragma once

#include <acs/core/Result.hpp>

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
    std::string _path;
    int _descriptor = -1;
    std::uint64_t _offset = 0; ///< Of the first line that is not read yet.
    std::uint64_t _line = 0;   ///< Lines that are read.

    WorldJournal(std::string path, int descriptor);

public:
    static constexpr std::uint64_t MAX_BYTES = 256U * 1024U * 1024U;
    static constexpr std::size_t MAX_LINE = 64U * 1024U;

    /// The lock of all writers, held while it exists. The system lifts it when the process ends, however it ends.
    class Lock
    {
        int _descriptor;

    public:
        explicit Lock(int descriptor);
        Lock(const Lock&) = delete;
        Lock& operator=(const Lock&) = delete;
        ~Lock();
    };

    using LineReader = std::function<Core::Result<void>(std::string_view line)>;

    WorldJournal(const WorldJournal&) = delete;
    WorldJournal& operator=(const WorldJournal&) = delete;

    WorldJournal(WorldJournal&& other) noexcept
        : _path(std::exchange(other._path, {})),
          _descriptor(std::exchange(other._descriptor, -1)),
          _offset(other._offset),
          _line(other._line)
    {
    }

    WorldJournal& operator=(WorldJournal&&) = delete;
    ~WorldJournal();

    /// Created when missing. All errors are EWorldError::JournalFailed, with path and line.
    [[nodiscard]] static Core::Result<WorldJournal> Open(const std::string& path);

    /// Waits for another writer, each of which holds it only while it reads the news and appends a line.
    [[nodiscard]] Lock Acquire() const;

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

#include "world/WorldJournal.hpp"

#include "world/EWorldError.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace ACS::Sim
{
namespace
{

constexpr mode_t FILE_MODE = 0666;
constexpr std::size_t CHUNK_BYTES = 64U * 1024U;
constexpr int LOCK_POLL_MS = 1;

} // namespace

WorldJournal::Lock::Lock(int descriptor)
    : _descriptor(descriptor)
{
}

WorldJournal::Lock::~Lock()
{
    if (_descriptor >= 0)
    {
        ::flock(_descriptor, LOCK_UN);
    }
}

WorldJournal::WorldJournal(std::string path, int descriptor)
    : _path(std::move(path)),
      _descriptor(descriptor)
{
}

WorldJournal::~WorldJournal()
{
    if (_descriptor >= 0)
    {
        ::close(_descriptor);
    }
}

Core::Result<WorldJournal> WorldJournal::Open(const std::string& path)
{
    constexpr int FLAGS =
        O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOCTTY | O_NONBLOCK; // O_NONBLOCK: a FIFO must not block
    WorldJournal journal(path, ::open(path.c_str(), FLAGS, FILE_MODE));  // NOLINT: the system's signature
    if (journal._descriptor < 0)
    {
        return journal.FailForErrno("a file that can be written");
    }
    const Core::Result<std::uint64_t> size = journal.GetSize();
    if (!size.has_value())
    {
        return tl::make_unexpected(size.error());
    }
    return journal;
}

Core::Result<WorldJournal::Lock> WorldJournal::Acquire()
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point deadline = Clock::now() + (_bLockMissed ? MISSED_LOCK_TIMEOUT : LOCK_TIMEOUT);
    while (::flock(_descriptor, LOCK_EX | LOCK_NB) != 0)
    {
        if (errno != EWOULDBLOCK && errno != EINTR)
        {
            return FailForErrno("a file that can be locked");
        }
        if (Clock::now() >= deadline)
        {
            _bLockMissed = true;
            return Core::Fail(
                EWorldError::JournalFailed,
                _path,
                fmt::format("its lock within {} s", LOCK_TIMEOUT.count()),
                "another process that holds it; end that process ('lslocks' lists it)");
        }
        ::poll(nullptr, 0, LOCK_POLL_MS); // polled, because flock has no time limit
    }
    _bLockMissed = false;
    return Lock(_descriptor);
}

Core::Result<void> WorldJournal::ReadNewLines(const LineReader& read)
{
    const Core::Result<std::uint64_t> size = GetSize();
    if (!size.has_value())
    {
        return tl::make_unexpected(size.error());
    }
    if (*size < _offset)
    {
        return Core::Fail(
            EWorldError::JournalFailed,
            _path,
            "a complete journal; restart this program",
            "a truncated one");
    }
    if (*size == _offset)
    {
        return {};
    }
    std::string text;
    std::array<char, CHUNK_BYTES> chunk{};
    std::uint64_t next = _offset;
    while (next < *size)
    {
        const ssize_t count = ::pread(_descriptor, chunk.data(), chunk.size(), static_cast<off_t>(next));
        if (count < 0 && errno == EINTR)
        {
            continue;
        }
        if (count < 0)
        {
            return FailForErrno("a file that can be read");
        }
        if (count == 0)
        {
            break;
        }
        next += static_cast<std::uint64_t>(count);
        text.append(chunk.data(), static_cast<std::size_t>(count));
        Core::Result<void> done = ReadLines(text, read);
        if (!done.has_value())
        {
            return done;
        }
    }
    return {};
}

Core::Result<void> WorldJournal::ReadLines(std::string& text, const LineReader& read)
{
    std::size_t begin = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin))
    {
        const Core::Result<void> done = read(std::string_view(text).substr(begin, end - begin));
        if (!done.has_value())
        {
            return Core::Fail(
                EWorldError::JournalFailed,
                fmt::format("{}:{}", _path, _line + 1),
                fmt::format(
                    "a valid next event ({}); remove the journal to start from the world file",
                    Core::Describe(done.error())));
        }
        _offset += end + 1 - begin;
        ++_line;
        begin = end + 1;
    }
    text.erase(0, begin);
    if (text.size() > MAX_LINE)
    {
        return Core::Fail(
            EWorldError::JournalFailed,
            fmt::format("{}:{}", _path, _line + 1),
            fmt::format("a line of at most {} bytes", MAX_LINE));
    }
    return {};
}

Core::Result<void> WorldJournal::Append(std::string line) const
{
    line += '\n';
    if (line.size() > MAX_LINE || _offset + line.size() > MAX_BYTES)
    {
        return Core::Fail(
            EWorldError::LimitExceeded,
            _path,
            fmt::format(
                "lines of at most {} bytes and a journal of at most {} bytes; remove the journal to start from the world file",
                MAX_LINE,
                MAX_BYTES));
    }
    const Core::Result<std::uint64_t> size = GetSize();
    if (!size.has_value())
    {
        return tl::make_unexpected(size.error());
    }
    if (*size > _offset && ::ftruncate(_descriptor, static_cast<off_t>(_offset)) != 0)
    {
        return FailForErrno("a file that can be written");
    }
    const ssize_t count = ::write(_descriptor, line.data(), line.size());
    if (count != static_cast<ssize_t>(line.size()))
    {
        auto failed = FailForErrno("a file that can be written");
        [[maybe_unused]] const int cut = ::ftruncate(_descriptor, static_cast<off_t>(_offset));
        return failed;
    }
    return {};
}

Core::Result<std::uint64_t> WorldJournal::GetSize() const
{
    struct stat status = {};
    if (::fstat(_descriptor, &status) != 0)
    {
        return FailForErrno("a file that can be read");
    }
    if (!S_ISREG(status.st_mode))
    {
        return Core::Fail(EWorldError::JournalFailed, _path, "a regular file");
    }
    if (status.st_nlink == 0)
    {
        return Core::Fail(
            EWorldError::JournalFailed,
            _path,
            "the journal in its place; restart this program",
            "it removed");
    }
    return static_cast<std::uint64_t>(status.st_size);
}

tl::unexpected<Core::Error> WorldJournal::FailForErrno(std::string_view what) const
{
    const int reason = errno;
    return Core::Fail(
        EWorldError::JournalFailed,
        _path,
        std::string(what),
        reason == 0 ? "an incomplete write" : std::generic_category().message(reason));
}

} // namespace ACS::Sim

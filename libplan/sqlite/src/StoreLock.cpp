#include "StoreLock.hpp"

#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <fstream>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr mode_t FILE_MODE = 0644;

/// Before the number of the log.
constexpr std::string_view NUMBER_WORD = "log ";
constexpr std::string_view NEEDS_LOG_WORD = "open";

std::string Encode(const StoreMark& mark)
{
    return mark.bNeedsLog ? fmt::format("{}\n", NEEDS_LOG_WORD) : fmt::format("{}{}\n", NUMBER_WORD, mark.number);
}

} // namespace

StoreLock::StoreLock(int descriptor, std::string storePath)
    : _descriptor(descriptor),
      _storePath(std::move(storePath))
{
}

StoreLock::~StoreLock()
{
    if (_descriptor >= 0)
    {
        ::close(_descriptor);
    }
}

Core::Result<void> StoreLock::Mark(const StoreMark& mark) const
{
    const std::string text = Encode(mark);
    const auto size = static_cast<off_t>(text.size());
    // Written over and then cut: a disk that is full takes that.
    const bool bWritten = ::pwrite(_descriptor, text.data(), text.size(), 0) == size
        && ::ftruncate(_descriptor, size) == 0 && ::fsync(_descriptor) == 0;
    if (!bWritten)
    {
        const std::string reason = std::generic_category().message(errno);
        return Refuse(
            EPlanningError::StoreFailed,
            _storePath,
            fmt::format("a file {} that can be written; look at its disk, and free some room", GetPath(_storePath)),
            fmt::format("writing it failed: {}", reason));
    }
    static_cast<void>(StoreFiles::TrySynchroniseFolder(GetPath(_storePath))); // not every file system can
    return {};
}

void StoreLock::Unmark() const
{
    [[maybe_unused]] const int failed = ::ftruncate(_descriptor, 0);
}

std::optional<StoreMark> StoreLock::ReadMarkOrNull(const std::string& storePath)
{
    std::ifstream file(GetPath(storePath));
    std::string line;
    if (!std::getline(file, line) || line.empty())
    {
        return std::nullopt;
    }
    StoreMark mark{0, !line.starts_with(NUMBER_WORD)};
    if (!mark.bNeedsLog)
    {
        const auto end = std::from_chars(line.data() + NUMBER_WORD.size(), line.data() + line.size(), mark.number);
        mark.bNeedsLog = end.ec != std::errc();
    }
    return mark;
}

std::string StoreLock::GetPath(const std::string& storePath)
{
    return StoreFiles::Resolve(storePath) + ".lock";
}

Core::Result<StoreLock> StoreLock::Acquire(const std::string& storePath)
{
    const std::string path = GetPath(storePath);
    const std::error_code code = make_error_code(EPlanningError::StoreFailed);
    StoreLock lock(
        ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, FILE_MODE),
        storePath); // NOLINT: the system's own signature
    if (lock._descriptor < 0)
    {
        return Core::Fail(code, path, "a file that can be created", std::generic_category().message(errno));
    }
    if (::flock(lock._descriptor, LOCK_EX | LOCK_NB) != 0)
    {
        const int reason = errno;
        return Core::Fail(
            code,
            storePath,
            "a store of this program alone; stop the other one, or choose another file",
            reason == EWOULDBLOCK ? "one that another program has open" : std::generic_category().message(reason));
    }
    return lock;
}

} // namespace ACS::Planning

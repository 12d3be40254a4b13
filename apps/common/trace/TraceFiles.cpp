#include "common/trace/TraceFiles.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view SUFFIX = ".ndjson";
constexpr std::size_t FLUSH_BYTES = 256U * 1024U;
constexpr off_t TAIL_BYTES = 4LL * 1024 * 1024;
constexpr std::uint64_t LARGEST_NUMBER = 999'999'999'999;

/// 0 if the file is not one of this trace.
std::uint64_t ReadNumber(const std::string& name, std::string_view prefix)
{
    if (name.size() <= prefix.size() + SUFFIX.size() || !name.starts_with(prefix) || !name.ends_with(SUFFIX))
    {
        return 0;
    }
    const std::string_view digits =
        std::string_view(name).substr(prefix.size(), name.size() - prefix.size() - SUFFIX.size());
    const std::uint64_t number = Core::ParseNumberOrNull<std::uint64_t>(digits).value_or(0);
    return number <= LARGEST_NUMBER ? number : 0;
}

using NumberedFiles = std::vector<std::pair<std::uint64_t, std::filesystem::path>>;

/// Ascending. A file of another type has a number that is in use, but is neither read nor deleted.
NumberedFiles ListNumbers(const std::string& folder, std::string_view prefix)
{
    NumberedFiles files;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    {
        const std::uint64_t number = ReadNumber(entry->path().filename().string(), prefix);
        if (number > 0)
        {
            files.emplace_back(number, entry->path());
        }
    }
    std::ranges::sort(files);
    return files;
}

/// Ascending. Neither links nor pipes nor devices: reading one could have no end.
NumberedFiles ListFiles(const std::string& folder, std::string_view prefix)
{
    NumberedFiles files = ListNumbers(folder, prefix);
    std::erase_if(files, [](const auto& file) {
        std::error_code error;
        return std::filesystem::symlink_status(file.second, error).type() != std::filesystem::file_type::regular;
    });
    return files;
}

/// -1: it is not a regular file, or cannot be read. The type may have changed since ListFiles.
int OpenForReading(const std::filesystem::path& path)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): POSIX has no other
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    struct stat status = {};
    if (file >= 0 && (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)))
    {
        ::close(file);
        return -1;
    }
    return file;
}

/// The last bytes of the file, at most TAIL_BYTES; empty if it cannot be read.
std::string ReadLastBytes(int file, off_t size)
{
    std::string bytes(static_cast<std::size_t>(std::min(size, TAIL_BYTES)), '\0');
    std::size_t done = 0;
    while (done < bytes.size())
    {
        const ssize_t count = ::pread(
            file,
            bytes.data() + done,
            bytes.size() - done,
            std::max<off_t>(size - TAIL_BYTES, 0) + static_cast<off_t>(done));
        if (count <= 0)
        {
            break;
        }
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return bytes;
}

/// The whole lines at the end of the file.
std::vector<std::string> ReadTail(const std::filesystem::path& path)
{
    std::vector<std::string> lines;
    const int file = OpenForReading(path);
    if (file < 0)
    {
        return lines;
    }
    const off_t size = ::lseek(file, 0, SEEK_END);
    const std::string bytes = ReadLastBytes(file, std::max<off_t>(size, 0));
    ::close(file);
    std::string_view rest = bytes;
    if (size > TAIL_BYTES)
    {
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    }
    // The last line may lack its end.
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n'))
    {
        lines.emplace_back(rest.substr(0, end));
        rest.remove_prefix(end + 1);
    }
    return lines;
}

std::error_code GetLastError()
{
    return {errno, std::generic_category()};
}

/// Whether another process writes this file.
bool IsLocked(const std::filesystem::path& path)
{
    const int file = OpenForReading(path);
    if (file < 0)
    {
        return false;
    }
    const bool bLocked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(file); // which releases the lock
    return bLocked;
}

/// Whether lines can be added; otherwise a crash of the machine has cut the last one.
bool EndsWithLine(const std::filesystem::path& path)
{
    const int file = OpenForReading(path);
    if (file < 0)
    {
        return false;
    }
    char last = '\n';
    const off_t size = ::lseek(file, 0, SEEK_END);
    const bool bRead = size == 0 || ::pread(file, &last, 1, size - 1) == 1;
    ::close(file);
    return bRead && last == '\n';
}

/// The filter may be empty.
std::vector<std::string> CollectNewestLines(
    const std::string& folder,
    const std::string& prefix,
    std::size_t maximum,
    std::size_t mostFiles,
    const std::function<bool(std::string_view line)>& filter)
{
    std::vector<std::string> newest;
    const auto files = ListFiles(folder, prefix);
    std::size_t read = 0;
    for (auto file = files.rbegin(); file != files.rend() && newest.size() < maximum && read < mostFiles;
         ++file, ++read)
    {
        std::vector<std::string> lines = ReadTail(file->second);
        if (filter)
        {
            std::erase_if(lines, [&filter](const std::string& line) { return !filter(line); });
        }
        const auto missing = static_cast<std::ptrdiff_t>(std::min(maximum - newest.size(), lines.size()));
        newest.insert(
            newest.begin(),
            std::make_move_iterator(lines.end() - missing),
            std::make_move_iterator(lines.end()));
    }
    return newest;
}

} // namespace

TraceFiles::TraceFiles(std::string path, TraceFileStyle style)
    : _path(std::move(path)),
      _style(std::move(style))
{
}

TraceFiles::~TraceFiles()
{
    Close();
}

std::error_code TraceFiles::Open(const TraceLimits& limits)
{
    if (limits.maxFiles == 0)
    {
        return OpenFile(_path, O_TRUNC);
    }
    std::error_code error;
    std::filesystem::create_directories(_path, error);
    return error ? error : OpenFirst(limits);
}

std::error_code TraceFiles::OpenFirst(const TraceLimits& limits)
{
    const auto files = ListFiles(_path, _style.prefix);
    if (!_style.bContinued)
    {
        const std::error_code busy = std::make_error_code(std::errc::device_or_resource_busy);
        if (!files.empty() && IsLocked(files.back().second))
        {
            return busy;
        }
        const std::error_code error =
            OpenNext(_style.bDeletedLater ? TraceLimits{limits.maxFileBytes, 2 * limits.maxFiles} : limits);
        _bFirst = !error && _style.bDeletedLater;
        return error == std::errc::file_exists ? busy : error; // another process has just started
    }
    if (files.empty())
    {
        return OpenNext(limits);
    }
    return Continue(files.back().second, limits);
}

std::error_code TraceFiles::Continue(const std::string& path, const TraceLimits& limits)
{
    return EndsWithLine(path) ? OpenFile(path, O_NOFOLLOW | O_NONBLOCK) : OpenNext(limits);
}

std::error_code TraceFiles::OpenNext(const TraceLimits& limits)
{
    if (limits.maxFiles == 0)
    {
        return OpenFile(_path, 0);
    }
    const NumberedFiles numbers = ListNumbers(_path, _style.prefix);
    const std::uint64_t number = numbers.empty() ? 1 : numbers.back().first + 1;
    if (number > LARGEST_NUMBER)
    {
        return std::make_error_code(std::errc::value_too_large);
    }
    _bFirst = false;
    DeleteOldestFiles(_path, _style.prefix, limits.maxFiles - 1); // before the new one needs their space
    return OpenFile(std::filesystem::path(_path) / fmt::format("{}{:06}{}", _style.prefix, number, SUFFIX), O_EXCL);
}

std::error_code TraceFiles::OpenFile(const std::string& path, int flags)
{
    Close();
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): POSIX has no other
    _file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | flags, _style.mode);
    if (_file < 0)
    {
        return GetLastError();
    }
    // Released when the file is closed, also by a crash. Without locks on its file system the trace is written all the same.
    static_cast<void>(::flock(_file, LOCK_EX | LOCK_NB));
    _current = path;
    _written = static_cast<std::uint64_t>(std::max<off_t>(::lseek(_file, 0, SEEK_END), 0));
    return {};
}

void TraceFiles::Close() noexcept
{
    if (_file >= 0)
    {
        ::close(std::exchange(_file, -1));
    }
    _written = 0;
    _buffer.clear();
    _bufferedLines = 0;
}

std::error_code TraceFiles::Append(std::string_view line, const TraceLimits& limits)
{
    if (_file < 0) // after an error
    {
        const std::error_code error = Continue(_current, limits);
        if (error)
        {
            _lostLines = 1;
            return error;
        }
    }
    const std::uint64_t size = _written + _buffer.size();
    if (size > 0 && size + line.size() + 1 > limits.maxFileBytes)
    {
        std::error_code error = Flush();
        if (error)
        {
            ++_lostLines;
            return error;
        }
        error = OpenNext(limits);
        if (error)
        {
            _lostLines = 1;
            return error;
        }
    }
    _buffer.append(line);
    _buffer += '\n';
    ++_bufferedLines;
    return _buffer.size() >= FLUSH_BYTES ? Flush() : std::error_code();
}

std::error_code TraceFiles::Flush()
{
    const std::error_code error = WriteBuffer();
    if (error)
    {
        _lostLines = _bufferedLines;
        // Truncates the file to the end of the last complete line.
        static_cast<void>(::ftruncate(_file, static_cast<off_t>(_written)) == 0);
        Close();
        return error;
    }
    _written += _buffer.size();
    _buffer.clear();
    _bufferedLines = 0;
    return {};
}

void TraceFiles::Discard() noexcept
{
    if (std::exchange(_bFirst, false))
    {
        ::unlink(_current.c_str());
        Close();
    }
}

std::size_t TraceFiles::GetLostLines() const noexcept
{
    return _lostLines;
}

std::error_code TraceFiles::WriteBuffer()
{
    std::size_t done = 0;
    while (done < _buffer.size())
    {
        const ssize_t count = ::write(_file, _buffer.data() + done, _buffer.size() - done);
        if (count < 0 && errno == EINTR)
        {
            continue;
        }
        if (count <= 0)
        {
            return count < 0 ? GetLastError() : std::make_error_code(std::errc::io_error);
        }
        done += static_cast<std::size_t>(count);
    }
    return {};
}

void DeleteOldestFiles(const std::string& folder, std::string_view prefix, std::size_t kept)
{
    const NumberedFiles files = ListFiles(folder, prefix);
    for (std::size_t i = 0; i + kept < files.size(); ++i)
    {
        std::error_code ignored;
        std::filesystem::remove(files[i].second, ignored);
    }
}

std::string DescribeTraceError(const std::error_code& error)
{
    if (error == std::errc::device_or_resource_busy)
    {
        return "another process of this program writes its trace there; give each process a folder of its own";
    }
    return error == std::errc::value_too_large ? "no number follows that of the newest file; remove this file"
                                               : error.message();
}

std::vector<std::string> ReadNewestLines(const std::string& folder, const std::string& prefix, std::size_t maximum)
{
    return CollectNewestLines(folder, prefix, maximum, std::numeric_limits<std::size_t>::max(), {});
}

std::vector<std::string> FindNewestLines(
    const std::string& folder,
    const std::string& prefix,
    std::size_t maximum,
    const std::function<bool(std::string_view line)>& filter)
{
    constexpr std::size_t MOST_FILES = 4; // of TAIL_BYTES each
    return CollectNewestLines(folder, prefix, maximum, MOST_FILES, filter);
}

} // namespace ACS::Apps

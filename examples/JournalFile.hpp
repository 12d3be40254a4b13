#pragma once

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

/// Lines that are on the disk when TryAppend returns. The last one may be torn by a kill: it counts as never written. A
/// second program cannot open the same file.
class JournalFile
{
    int _file = -1;
    off_t _wholeBytes = 0; ///< Of the lines that were written whole.

public:
    JournalFile() = default;
    JournalFile(const JournalFile&) = delete;
    JournalFile& operator=(const JournalFile&) = delete;

    ~JournalFile()
    {
        ::close(_file);
    }

    /// The lines of the file; nullopt if it cannot be used (see errno).
    [[nodiscard]] std::optional<std::vector<std::string>> OpenOrNull(const std::string& path)
    {
        std::signal(SIGXFSZ, SIG_IGN); // A limit of the file size is an error of write, like a full disk.
        _file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, S_IRUSR | S_IWUSR);
        if (_file < 0 || ::flock(_file, LOCK_EX | LOCK_NB) != 0)
        {
            return std::nullopt;
        }
        std::optional<std::string> textOrNull = ReadOrNull();
        if (!textOrNull.has_value()) // Not a file without lines: the first line would empty it.
        {
            return std::nullopt;
        }
        std::vector<std::string> lines;
        std::istringstream old(std::move(*textOrNull));
        for (std::string line; std::getline(old, line) && !old.eof();)
        {
            _wholeBytes += static_cast<off_t>(line.size() + 1);
            lines.push_back(std::move(line));
        }
        return TrySyncFolder(path) ? std::optional(std::move(lines)) : std::nullopt;
    }

    /// False if the line cannot be written (see errno); nothing of it remains in the file.
    [[nodiscard]] bool TryAppend(std::string line)
    {
        line += '\n';
        // A torn line remains until the first line is written: the caller may find that the file is not its journal.
        if (::ftruncate(_file, _wholeBytes) == 0 && TryWrite(line) && ::fdatasync(_file) == 0)
        {
            _wholeBytes += static_cast<off_t>(line.size());
            return true;
        }
        const int cause = errno;
        if (::ftruncate(_file, _wholeBytes) != 0) // The next line would continue this one.
        {
            ::close(std::exchange(_file, -1));
        }
        errno = cause;
        return false;
    }

private:
    [[nodiscard]] std::optional<std::string> ReadOrNull() const
    {
        std::string text;
        std::array<char, 65'536> part{};
        while (const ssize_t count = ::read(_file, part.data(), part.size()))
        {
            if (count < 0 && errno != EINTR)
            {
                return std::nullopt;
            }
            text.append(part.data(), count < 0 ? 0 : static_cast<std::size_t>(count));
        }
        return text;
    }

    /// A new file survives the loss of power only if its folder is on the disk, too.
    [[nodiscard]] static bool TrySyncFolder(const std::string& path)
    {
        const std::string folder = std::filesystem::path(path).parent_path().string();
        const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        const bool bSynced = file >= 0 && ::fsync(file) == 0;
        ::close(file);
        return bSynced;
    }

    [[nodiscard]] bool TryWrite(std::string_view text) const
    {
        while (!text.empty())
        {
            const ssize_t count = ::write(_file, text.data(), text.size());
            if (count < 0 && errno != EINTR)
            {
                return false;
            }
            text.remove_prefix(count < 0 ? 0 : static_cast<std::size_t>(count));
        }
        return true;
    }
};

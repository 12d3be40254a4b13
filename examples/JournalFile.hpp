#pragma once

#include <fcntl.h>
#include <fstream>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

/// Lines that are on the disk when TryAppend returns. The last one may be torn by a kill: it counts as never written.
class JournalFile
{
    int _file = -1;

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
        std::vector<std::string> lines;
        off_t wholeBytes = 0;
        std::ifstream old(path);
        for (std::string line; std::getline(old, line) && !old.eof();)
        {
            wholeBytes += static_cast<off_t>(line.size() + 1);
            lines.push_back(std::move(line));
        }
        _file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, S_IRUSR | S_IWUSR);
        const bool bUsable = _file >= 0 && ::ftruncate(_file, wholeBytes) == 0;
        return bUsable ? std::optional(std::move(lines)) : std::nullopt;
    }

    /// False if the line cannot be written (see errno).
    [[nodiscard]] bool TryAppend(std::string line) const
    {
        line += '\n';
        return ::write(_file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) && ::fdatasync(_file) == 0;
    }
};

#pragma once

#include "commands/CommandError.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsctl
{

/// Reads the trace of one program: the lines of its files, in the order in which they were written.
class TraceSource final
{
public:
    /// Lines of several programs are merged by it: wall clock, then, for lines of one machine within a millisecond, monotonic
    /// clock in microseconds.
    using Key = std::pair<std::string, std::uint64_t>;

private:
    std::vector<std::filesystem::path> _files; ///< The next one last.
    std::filesystem::path _path;               ///< Of the open file.
    std::ifstream _file;
    std::uint64_t _lineNumber = 0;
    std::string _line;
    Key _key;

public:
    /// The files, the oldest first.
    explicit TraceSource(std::vector<std::filesystem::path> files);

    /// Reads the next line: false at the end. An incomplete line at the end of a file is omitted, as is a file that was deleted since.
    /// Fails if a file cannot be read, or a line is not one of a trace.
    [[nodiscard]] Outcome<bool> ReadNext();

    /// The line that was read, without its end.
    [[nodiscard]] const std::string& GetLine() const noexcept;
    [[nodiscard]] const Key& GetKey() const noexcept;

private:
    /// False: there is no further file.
    [[nodiscard]] Outcome<bool> OpenNext();
};

/// The traces in these files and folders. Of a folder the files *.ndjson are read; those whose names differ only in their number
/// are one source.
[[nodiscard]] Outcome<std::vector<TraceSource>> FindTraceSources(const std::vector<std::string>& paths);

} // namespace ACS::Acsctl

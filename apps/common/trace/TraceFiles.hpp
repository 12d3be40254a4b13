#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::Apps
{

/// Bounds the size of a trace to about their product.
struct TraceLimits
{
    // What a configuration or a command line may set.
    static constexpr std::int64_t SMALLEST_FILE = 4'096;
    static constexpr std::int64_t LARGEST_FILE = 1'000'000'000'000;
    static constexpr std::int64_t MOST_FILES = 10'000;

    std::uint64_t maxFileBytes = 100U * 1024U * 1024U; ///< Exceeded only by a single line that is longer.
    std::size_t maxFiles = 10;                         ///< The oldest are deleted; 0: the path is one file.

    bool operator==(const TraceLimits&) const = default;
};

/// How the files of a folder are named and opened.
struct TraceFileStyle
{
    std::string prefix = "acsd-";
    std::uint32_t mode = 0600; ///< Messages may be confidential.
    bool bContinued = false;   ///< The newest file is continued at a start; otherwise a start begins a new one.
    /// A start that fails leaves the files as they were: Open deletes none, unless starts that crashed have left twice as many as
    /// allowed.
    bool bDeletedLater = false;
};

/// The files of a trace: either numbered files in a folder ("acsd-000001.ndjson" and up), of which the oldest are deleted, or
/// one file, which is replaced at the start. A file never ends with a partial line, even if the disk is full. Used by one
/// thread.
class TraceFiles final
{
    std::string _path;
    TraceFileStyle _style;
    std::string _current; ///< Path of the file that is written, also after an error.
    std::string _buffer;
    std::uint64_t _written = 0; ///< Bytes of the file, all of whole lines.
    std::size_t _bufferedLines = 0;
    std::size_t _lostLines = 0;
    int _file = -1;
    bool _bFirst = false; ///< The file is the one that Open has created.

public:
    explicit TraceFiles(std::string path, TraceFileStyle style = {});
    TraceFiles(const TraceFiles&) = delete;
    TraceFiles& operator=(const TraceFiles&) = delete;
    ~TraceFiles();

    /// Creates the folder if necessary, and a file. std::errc::device_or_resource_busy: another process writes files of this prefix to
    /// the folder; each would delete files of the other one. Only regular files are read, continued or deleted.
    [[nodiscard]] std::error_code Open(const TraceLimits& limits);

    /// Adds a line, given without its line end. It is written by the next Flush at the latest. After an error this line and all
    /// unwritten ones are lost (GetLostLines), and the next call opens the same file again.
    [[nodiscard]] std::error_code Append(std::string_view line, const TraceLimits& limits);
    [[nodiscard]] std::error_code Flush();

    /// Deletes the file that Open has created, unless another one has followed. Only with bDeletedLater.
    void Discard() noexcept;

    /// Number of lines lost by the last error.
    [[nodiscard]] std::size_t GetLostLines() const noexcept;

private:
    [[nodiscard]] std::error_code OpenFirst(const TraceLimits& limits);
    [[nodiscard]] std::error_code Continue(const std::string& path, const TraceLimits& limits);
    [[nodiscard]] std::error_code OpenNext(const TraceLimits& limits);
    [[nodiscard]] std::error_code OpenFile(const std::string& path, int flags);
    [[nodiscard]] std::error_code WriteBuffer();
    void Close() noexcept;
};

/// Deletes the oldest files of the folder with this prefix, until this number is left. Only regular files are counted. From any
/// thread.
void DeleteOldestFiles(const std::string& folder, std::string_view prefix, std::size_t kept);

/// Why a trace cannot be opened: the text of the error, or what std::errc::device_or_resource_busy and value_too_large mean.
[[nodiscard]] std::string DescribeTraceError(const std::error_code& error);

/// The newest lines in the files of the folder with this prefix, the oldest of them first, without their ends. Of each file
/// only its last 4 MiB are read. Only regular files are read, not links. From any thread.
[[nodiscard]] std::vector<std::string> ReadNewestLines(
    const std::string& folder,
    const std::string& prefix,
    std::size_t maximum);

/// As ReadNewestLines, only those for which the filter is true, in the newest files only: at most 16 MiB are read.
[[nodiscard]] std::vector<std::string> FindNewestLines(
    const std::string& folder,
    const std::string& prefix,
    std::size_t maximum,
    const std::function<bool(std::string_view line)>& filter);

} // namespace ACS::Apps

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace ACS::Acsd
{

/// How much room a trace takes: about their product.
struct TraceLimits
{
    std::uint64_t maxFileBytes = 100U * 1024U * 1024U; ///< A file is never longer, but for a line that is.
    std::size_t maxFiles = 10;                         ///< The oldest go; at least 1.

    bool operator==(const TraceLimits&) const = default;
};

/// Lines in files that follow one another in a folder, "acsd-000001.ndjson" and up, the oldest of which are deleted. Other
/// files in the folder are left alone. A file never ends with half a line, even where the disk is full. One thread.
class TraceFolder final
{
    std::string _path;
    std::string _buffer;
    std::uint64_t _written = 0; ///< Bytes of the file, all of whole lines.
    std::size_t _bufferedLines = 0;
    std::size_t _lostLines = 0;
    int _file = -1;

    [[nodiscard]] std::error_code OpenNext(const TraceLimits& limits);
    [[nodiscard]] std::error_code WriteBuffer();
    void Close() noexcept;

public:
    /// Opens nothing.
    explicit TraceFolder(std::string path);
    TraceFolder(const TraceFolder&) = delete;
    TraceFolder& operator=(const TraceFolder&) = delete;
    ~TraceFolder();

    /// Makes the folder, where it is not there, and the next file in it.
    [[nodiscard]] std::error_code Open(const TraceLimits& limits);

    /// Adds a line (without its end). Written with the next Flush, or before. After an error the line and those that were
    /// not written yet are lost (GetLostLines) and the file is closed; the next call begins another one.
    [[nodiscard]] std::error_code Append(std::string_view line, const TraceLimits& limits);
    [[nodiscard]] std::error_code Flush();

    /// Of the last error.
    [[nodiscard]] std::size_t GetLostLines() const noexcept;
};

} // namespace ACS::Acsd

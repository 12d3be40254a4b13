#pragma once

#include <cstddef>
#include <deque>
#include <string>

namespace ACS::Apps
{

/// The newest lines of a log in memory, bounded in number and bytes.
class NewestLines final
{
    std::size_t _maxLines;
    std::size_t _maxBytes;
    std::size_t _bytes = 0;
    std::deque<std::string> _lines; ///< The oldest first.

public:
    NewestLines(std::size_t maxLines, std::size_t maxBytes);

    /// Adds a line, given without its end. A line longer than the bound is kept alone.
    void Add(std::string line);

    /// The oldest first, each without its end.
    [[nodiscard]] const std::deque<std::string>& GetLines() const noexcept;

    /// At most this number of lines, the oldest of them first, each with its end.
    [[nodiscard]] std::string GetText(std::size_t lines) const;
};

} // namespace ACS::Apps

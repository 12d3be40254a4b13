#include "common/trace/NewestLines.hpp"

#include <algorithm>
#include <utility>

namespace ACS::Apps
{

NewestLines::NewestLines(std::size_t maxLines, std::size_t maxBytes)
    : _maxLines(maxLines),
      _maxBytes(maxBytes)
{
}

void NewestLines::Add(std::string line)
{
    _bytes += line.size();
    _lines.push_back(std::move(line));
    while (_lines.size() > 1 && (_lines.size() > _maxLines || _bytes > _maxBytes))
    {
        _bytes -= _lines.front().size();
        _lines.pop_front();
    }
}

const std::deque<std::string>& NewestLines::GetLines() const noexcept
{
    return _lines;
}

std::string NewestLines::GetText(std::size_t lines) const
{
    std::string text;
    for (std::size_t i = _lines.size() - std::min(lines, _lines.size()); i < _lines.size(); ++i)
    {
        text += _lines[i];
        text += '\n';
    }
    return text;
}

} // namespace ACS::Apps

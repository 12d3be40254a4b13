#include "common/trace/LineCollector.hpp"

#include <cstddef>
#include <utility>

namespace ACS::Apps
{

namespace
{

/// A line without an end does not fill the memory.
constexpr std::size_t LONGEST_LINE = 1024U * 1024U;

void PassLine(std::string_view line, const LineCollector::LineHandler& onLine)
{
    if (line.ends_with('\r'))
    {
        line.remove_suffix(1);
    }
    if (!line.empty())
    {
        onLine(line);
    }
}

} // namespace

void LineCollector::Add(std::string_view bytes, const LineHandler& onLine)
{
    for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n'))
    {
        const std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(end + 1);
        if (_kept.empty())
        {
            PassLine(line, onLine);
            continue;
        }
        _kept.append(line);
        PassLine(std::exchange(_kept, {}), onLine);
    }
    _kept.append(bytes);
    if (_kept.size() > LONGEST_LINE)
    {
        PassLine(std::exchange(_kept, {}), onLine);
    }
}

void LineCollector::Finish(const LineHandler& onLine)
{
    PassLine(std::exchange(_kept, {}), onLine);
}

} // namespace ACS::Apps

#include "OddityLog.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Acsd
{

namespace
{

std::size_t CountDigits(std::uint64_t number)
{
    return fmt::format_int(number).size();
}

} // namespace

bool IsWorthALine(std::uint64_t total, std::uint64_t news)
{
    const std::uint64_t before = total - std::min(news, total);
    return before == 0 || CountDigits(before) != CountDigits(total);
}

OddityLog::OddityLog(Core::Logger logger)
    : _logger(std::move(logger))
{
}

void OddityLog::Note(const std::string& robotID, std::string_view kind, std::string_view detail)
{
    const std::uint64_t total = ++_counts[{robotID, std::string(kind)}];
    if (IsWorthALine(total))
    {
        _logger.Warning(
            "the robot says what cannot be",
            {{"robotId", robotID}, {"what", kind}, {"detail", detail}, {"count", fmt::format_int(total).str()}});
    }
}

const std::map<OddityLog::Key, std::uint64_t>& OddityLog::GetCounts() const noexcept
{
    return _counts;
}

} // namespace ACS::Acsd

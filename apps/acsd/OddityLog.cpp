#include "OddityLog.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

OddityLog::OddityLog(Core::Logger logger, const Core::IClock& clock)
    : _clock(clock),
      _log(std::move(logger))
{
}

void OddityLog::Note(const std::string& robotID, std::string_view kind, std::string_view detail)
{
    const std::uint64_t total = ++_counts[{robotID, std::string(kind)}];
    _log.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Warning,
        fmt::format("{} {}", robotID, kind),
        "the robot says what cannot be",
        {{"robotId", robotID}, {"what", kind}, {"detail", detail}, {"count", fmt::format_int(total).str()}});
}

const std::map<OddityLog::Key, std::uint64_t>& OddityLog::GetCounts() const noexcept
{
    return _counts;
}

} // namespace ACS::Acsd

#include "common/LogThinner.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Apps
{

LogThinner::LogThinner(Core::Logger logger, std::size_t few)
    : _logger(std::move(logger)),
      _few(few)
{
}

void LogThinner::Write(
    Core::SteadyTime now,
    Core::ELogLevel level,
    std::string_view kind,
    std::string_view message,
    std::initializer_list<Core::LogField> fields)
{
    Run& run = FindRun(now, kind);
    if (run.told > 0 && now - run.lastSeen >= INTERVAL)
    {
        run.told = 0;
    }
    run.lastSeen = now;
    if (run.told >= _few && now - run.lastTold < INTERVAL)
    {
        ++run.leftOut;
        return;
    }
    ++run.told;
    run.lastTold = now;
    const std::uint64_t leftOut = std::exchange(run.leftOut, 0);
    if (leftOut == 0)
    {
        _logger.Write(level, message, fields);
    }
    else
    {
        _logger.Write(level, fmt::format("{} ({} like it left out before)", message, leftOut), fields);
    }
}

LogThinner::Run& LogThinner::FindRun(Core::SteadyTime now, std::string_view kind)
{
    const auto found = _runs.find(kind);
    if (found != _runs.end())
    {
        return found->second;
    }
    if (_runs.size() >= MOST_KINDS)
    {
        std::erase_if(_runs, [now](const auto& entry) {
            return entry.second.leftOut == 0 && now - entry.second.lastSeen >= INTERVAL;
        });
    }
    return _runs[_runs.size() < MOST_KINDS ? std::string(kind) : std::string()];
}

} // namespace ACS::Apps

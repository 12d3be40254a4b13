#include "common/log/LogRateLimiter.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Apps
{

LogRateLimiter::LogRateLimiter(Core::Logger logger, std::size_t burst)
    : _logger(std::move(logger)),
      _burst(burst)
{
}

void LogRateLimiter::Write(
    Core::SteadyTime now,
    Core::ELogLevel level,
    std::string_view kind,
    std::string_view message,
    std::initializer_list<Core::LogField> fields)
{
    Kind& entry = FindKind(now, kind);
    if (entry.written > 0 && now - entry.lastSeen >= INTERVAL)
    {
        entry.written = 0;
    }
    entry.lastSeen = now;
    if (entry.written >= _burst && now - entry.lastWritten < INTERVAL)
    {
        ++entry.suppressed;
        return;
    }
    ++entry.written;
    entry.lastWritten = now;
    const std::uint64_t suppressed = std::exchange(entry.suppressed, 0);
    if (suppressed == 0)
    {
        _logger.Write(level, message, fields);
    }
    else
    {
        _logger.Write(level, fmt::format("{} ({} similar lines suppressed)", message, suppressed), fields);
    }
}

LogRateLimiter::Kind& LogRateLimiter::FindKind(Core::SteadyTime now, std::string_view kind)
{
    const auto found = _kinds.find(kind);
    if (found != _kinds.end())
    {
        return found->second;
    }
    if (_kinds.size() >= MAX_KINDS)
    {
        std::erase_if(_kinds, [now](const auto& entry) { return now - entry.second.lastSeen >= INTERVAL; });
    }
    return _kinds[_kinds.size() < MAX_KINDS ? std::string(kind) : std::string()];
}

} // namespace ACS::Apps

#include "config/OperationsConfig.hpp"

#include <cstdint>
#include <string>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;

Core::ELogLevel ReadLogLevel(const ConfigSection& log)
{
    const std::string word = log.GetWord("level", {"debug", "info", "warning", "error"}, "info");
    if (word == "debug")
    {
        return Core::ELogLevel::Debug;
    }
    if (word == "info")
    {
        return Core::ELogLevel::Info;
    }
    return word == "warning" ? Core::ELogLevel::Warning : Core::ELogLevel::Error;
}

} // namespace

void ReadOperationsConfig(const ConfigSection& root, OperationsConfig& config)
{
    const ConfigSection log = root.GetSection("log");
    config.logLevel = ReadLogLevel(log);
    config.stallLimit = log.GetDuration("stall_limit", 10ms, 1h, config.stallLimit);

    const ConfigSection trace = root.GetSection("trace");
    config.trace.maxFileBytes = static_cast<std::uint64_t>(trace.GetInteger(
        "max_file_bytes",
        Apps::TraceLimits::SMALLEST_FILE,
        Apps::TraceLimits::LARGEST_FILE,
        static_cast<std::int64_t>(config.trace.maxFileBytes)));
    config.trace.maxFiles = static_cast<std::size_t>(trace.GetInteger(
        "max_files",
        1,
        Apps::TraceLimits::MOST_FILES,
        static_cast<std::int64_t>(config.trace.maxFiles)));

    config.workGrace = root.GetSection("comm").GetDuration("grace", 0ms, 1h, config.workGrace);

    const ConfigSection robot = root.GetSection("robot");
    config.offlineAfter = robot.GetDuration("offline_after", 100ms, 1h, config.offlineAfter);
    config.loadTimeout = robot.GetDuration("load_timeout", 0ms, 1h, config.loadTimeout);
    config.statusInterval = robot.GetDuration("status_interval", 0ms, 1h, config.statusInterval);

    config.drainTimeout = root.GetSection("shutdown").GetDuration("drain_timeout", 0ms, 1min, config.drainTimeout);
}

} // namespace ACS::Acsd

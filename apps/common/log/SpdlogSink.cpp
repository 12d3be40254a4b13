#include "common/log/SpdlogSink.hpp"

#include "common/log/LogText.hpp"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cassert>

namespace ACS::Apps
{

namespace
{

constexpr const char* PATTERN = "%Y-%m-%dT%H:%M:%S.%eZ %l %v";

spdlog::level::level_enum MakeLevel(Core::ELogLevel level)
{
    switch (level)
    {
        case Core::ELogLevel::Debug:
            return spdlog::level::debug;
        case Core::ELogLevel::Info:
            return spdlog::level::info;
        case Core::ELogLevel::Warning:
            return spdlog::level::warn;
        case Core::ELogLevel::Error:
            return spdlog::level::err;
        default:
            assert(false && "unhandled ELogLevel");
            return spdlog::level::err;
    }
}

} // namespace

struct SpdlogSink::Impl
{
    spdlog::logger logger{"acs", std::make_shared<spdlog::sinks::stderr_sink_st>()};
};

SpdlogSink::SpdlogSink(Core::ELogLevel level)
    : _impl(std::make_unique<Impl>())
{
    _impl->logger.set_formatter(std::make_unique<spdlog::pattern_formatter>(PATTERN, spdlog::pattern_time_type::utc));
    _impl->logger.set_level(MakeLevel(level));
}

SpdlogSink::~SpdlogSink() = default;

void SpdlogSink::SetLevel(Core::ELogLevel level)
{
    _impl->logger.set_level(MakeLevel(level));
}

bool SpdlogSink::ShouldWrite(Core::ELogLevel level) const
{
    return _impl->logger.should_log(MakeLevel(level));
}

void SpdlogSink::Write(
    Core::ELogLevel level,
    std::string_view component,
    std::string_view message,
    std::initializer_list<Core::LogField> fields)
{
    const std::string text = MakeLogText(component, message, fields);
    _impl->logger.log(MakeLevel(level), spdlog::string_view_t(text.data(), text.size()));
}

} // namespace ACS::Apps

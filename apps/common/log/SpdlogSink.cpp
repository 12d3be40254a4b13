#include "common/log/SpdlogSink.hpp"

#include "common/log/LineWriter.hpp"
#include "common/log/LogText.hpp"

#include <fmt/format.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cassert>
#include <string>
#include <unistd.h>
#include <utility>

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

std::unique_ptr<spdlog::pattern_formatter> MakeFormatter()
{
    return std::make_unique<spdlog::pattern_formatter>(PATTERN, spdlog::pattern_time_type::utc);
}

/// On the writer's thread: with a formatter of its own.
std::string DescribeDropped(std::uint64_t count)
{
    const std::string text = MakeLogText(
        "log",
        "lines were dropped because standard error was not read in time",
        {{"lines", fmt::format_int(count).c_str()}});
    spdlog::memory_buf_t line;
    MakeFormatter()->format(spdlog::details::log_msg("log", spdlog::level::warn, text), line);
    return fmt::to_string(line);
}

class LineSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex>
{
    LineWriter _writer{STDERR_FILENO, DescribeDropped};

public:
    [[nodiscard]] std::uint64_t GetDropped() const
    {
        return _writer.GetDropped();
    }

protected:
    void sink_it_(const spdlog::details::log_msg& message) override
    {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        _writer.Write({line.data(), line.size()});
    }

    void flush_() override
    {
        _writer.Flush();
    }
};

spdlog::sink_ptr MakeDirectSink()
{
    return std::make_shared<spdlog::sinks::stderr_sink_st>();
}

} // namespace

struct SpdlogSink::Impl
{
    std::shared_ptr<LineSink> queueOrNull;
    spdlog::logger logger;

    explicit Impl(std::shared_ptr<LineSink> queue)
        : queueOrNull(std::move(queue)),
          logger("acs", queueOrNull != nullptr ? spdlog::sink_ptr(queueOrNull) : MakeDirectSink())
    {
    }
};

SpdlogSink::SpdlogSink(Core::ELogLevel level, ELogWriting writing)
    : _impl(std::make_unique<Impl>(writing == ELogWriting::Queued ? std::make_shared<LineSink>() : nullptr))
{
    _impl->logger.set_formatter(MakeFormatter());
    _impl->logger.set_level(MakeLevel(level));
}

SpdlogSink::~SpdlogSink() = default;

void SpdlogSink::SetLevel(Core::ELogLevel level)
{
    _impl->logger.set_level(MakeLevel(level));
}

void SpdlogSink::Flush()
{
    _impl->logger.flush();
}

std::uint64_t SpdlogSink::GetDropped() const
{
    return _impl->queueOrNull == nullptr ? 0 : _impl->queueOrNull->GetDropped();
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

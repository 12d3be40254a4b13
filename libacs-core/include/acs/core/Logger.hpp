#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Core
{

enum class ELogLevel : std::uint8_t
{
    Debug,
    Info,
    Warning,
    Error,
};

/// One named value of a log line, for example {"planId", "PLAN-1"}. Views: valid during the call only.
struct LogField
{
    std::string_view key;
    std::string_view value;
};

/// The destination of log lines, for example spdlog. Called on the thread that logs; must not throw.
class ACS_API ILogSink
{
public:
    ILogSink() = default;
    ILogSink(const ILogSink&) = delete;
    ILogSink& operator=(const ILogSink&) = delete;
    virtual ~ILogSink() = default;

    [[nodiscard]] virtual bool ShouldWrite(ELogLevel level) const = 0;
    virtual void Write(
        ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<LogField> fields) = 0;
};

/// A sink and the name of the component that logs. Cheap to copy; the sink must outlive all copies. There is no global
/// logger.
class ACS_API Logger
{
    ILogSink* _sinkOrNull = nullptr;
    std::string _component;

public:
    /// Discards everything.
    Logger() = default;
    Logger(ILogSink& sink, std::string component);

    void Debug(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    void Info(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    void Warning(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    void Error(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    void Write(ELogLevel level, std::string_view message, std::initializer_list<LogField> fields) const;

    /// A logger for the same sink with another component name.
    [[nodiscard]] Logger MakeFor(std::string component) const;
};

} // namespace ACS::Core

#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// Severity of a log line, ascending.
enum class ELogLevel : std::uint8_t
{
    Debug,   ///< For the developer.
    Info,    ///< A change of state that an operator may want to follow.
    Warning, ///< A disturbance that the component handles by itself.
    Error,   ///< Something that an operator has to correct.
};

/// One named value of a log line, for example {"planId", "PLAN-1"}. Views: valid during the call only.
struct LogField
{
    std::string_view key;   ///< For a structured log, such as "planId".
    std::string_view value; ///< UTF-8; may contain text of a peer.
};

/// The destination of log lines, for example spdlog. Called on the thread that logs; must not throw.
class ACS_API ILogSink
{
public:
    ILogSink() = default;
    ILogSink(const ILogSink&) = delete;
    ILogSink& operator=(const ILogSink&) = delete;
    virtual ~ILogSink() = default;

    /// Whether lines of this level are written. Called before each Write.
    [[nodiscard]] virtual bool ShouldWrite(ELogLevel level) const = 0;
    /// Writes one line. The component is that of the logger, the message a fixed text. All views are valid during the call
    /// only.
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
    /// Logs to the sink, which must outlive this logger and its copies.
    Logger(ILogSink& sink, std::string component);

    /// Logs with ELogLevel::Debug.
    void Debug(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    /// Logs with ELogLevel::Info.
    void Info(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    /// Logs with ELogLevel::Warning.
    void Warning(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    /// Logs with ELogLevel::Error.
    void Error(std::string_view message, std::initializer_list<LogField> fields = {}) const;
    /// Logs with a level that is known at run time only.
    void Write(ELogLevel level, std::string_view message, std::initializer_list<LogField> fields) const;

    /// A logger for the same sink with another component name.
    [[nodiscard]] Logger MakeFor(std::string component) const;
};

} // namespace ACS::Core

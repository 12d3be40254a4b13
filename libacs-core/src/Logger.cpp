#include <acs/core/Logger.hpp>

#include <utility>

namespace ACS::Core
{

Logger::Logger(ILogSink& sink, std::string component)
    : _sinkOrNull(&sink),
      _component(std::move(component))
{
}

void Logger::Debug(std::string_view message, std::initializer_list<LogField> fields) const
{
    Write(ELogLevel::Debug, message, fields);
}

void Logger::Info(std::string_view message, std::initializer_list<LogField> fields) const
{
    Write(ELogLevel::Info, message, fields);
}

void Logger::Warning(std::string_view message, std::initializer_list<LogField> fields) const
{
    Write(ELogLevel::Warning, message, fields);
}

void Logger::Error(std::string_view message, std::initializer_list<LogField> fields) const
{
    Write(ELogLevel::Error, message, fields);
}

void Logger::Write(ELogLevel level, std::string_view message, std::initializer_list<LogField> fields) const
{
    if (_sinkOrNull != nullptr && _sinkOrNull->ShouldWrite(level))
    {
        _sinkOrNull->Write(level, _component, message, fields);
    }
}

Logger Logger::MakeFor(std::string component) const
{
    Logger logger = *this;
    logger._component = std::move(component);
    return logger;
}

} // namespace ACS::Core

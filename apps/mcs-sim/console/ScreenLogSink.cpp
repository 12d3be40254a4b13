#include "console/ScreenLogSink.hpp"

namespace ACS::McsSim
{

ScreenLogSink::ScreenLogSink(Core::ILogSink& sink, Screen& screen)
    : _sink(sink),
      _screen(screen)
{
}

bool ScreenLogSink::ShouldWrite(Core::ELogLevel level) const
{
    return _sink.ShouldWrite(level);
}

void ScreenLogSink::Write(
    Core::ELogLevel level,
    std::string_view component,
    std::string_view message,
    std::initializer_list<Core::LogField> fields)
{
    if (_sink.ShouldWrite(level))
    {
        _screen.Erase();
        _sink.Write(level, component, message, fields);
    }
}

} // namespace ACS::McsSim

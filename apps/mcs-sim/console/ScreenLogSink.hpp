#pragma once

#include "console/Screen.hpp"
#include <acs/core/Logger.hpp>

#include <initializer_list>
#include <string_view>

namespace ACS::McsSim
{

/// Log lines that go to the same terminal as a live view: takes the view away before each, so that they do not mix.
class ScreenLogSink final : public Core::ILogSink
{
    Core::ILogSink& _sink;
    Screen& _screen;

public:
    /// Both outlive it.
    ScreenLogSink(Core::ILogSink& sink, Screen& screen);

    [[nodiscard]] bool ShouldWrite(Core::ELogLevel level) const override;
    void Write(
        Core::ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<Core::LogField> fields) override;
};

} // namespace ACS::McsSim

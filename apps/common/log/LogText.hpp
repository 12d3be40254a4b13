#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// "component: message key=value …" on one line: empty values and those with spaces or quotes are quoted, and control
/// characters are escaped, so that what a peer sent cannot forge a line. Always UTF-8.
[[nodiscard]] std::string MakeLogText(
    std::string_view component,
    std::string_view message,
    std::initializer_list<Core::LogField> fields);

/// Appends a control character as \xNN, any other byte unchanged.
void AppendPrintable(std::string& out, char character);

/// "debug", "info", "warning", "error"
[[nodiscard]] Core::Result<Core::ELogLevel> ParseLogLevel(std::string_view text);

} // namespace ACS::Apps

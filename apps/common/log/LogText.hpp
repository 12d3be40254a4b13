#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Result.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// "component: message key=value …" on one line: empty values and those with spaces or quotes are quoted, and control
/// characters are escaped as by MakePrintable, so that what a peer sent cannot forge a line. Always UTF-8.
[[nodiscard]] std::string MakeLogText(
    std::string_view component,
    std::string_view message,
    std::initializer_list<Core::LogField> fields);

/// The text with \xNN for each byte of a control character (C0, C1, ends of lines, direction of text) and for each byte that is not
/// valid UTF-8: it cannot control a terminal, and looks as it is.
[[nodiscard]] std::string MakePrintable(std::string_view text);

/// "debug", "info", "warning", "error"
[[nodiscard]] Core::Result<Core::ELogLevel> ParseLogLevel(std::string_view text);

} // namespace ACS::Apps

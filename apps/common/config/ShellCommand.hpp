#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// The word as a shell must read it: between single quotes if it has any character with a meaning for a shell.
[[nodiscard]] std::string QuoteForShell(std::string_view word);

/// A command line of acsctl to paste: "acsctl resume P1", "acsctl resume 'P 1'", "acsctl resume -- -P1". The name of the command is
/// not quoted; with a word that begins with "-", "--" precedes the words.
[[nodiscard]] std::string MakeShellCommand(std::string_view command, const std::vector<std::string>& words);

} // namespace ACS::Apps

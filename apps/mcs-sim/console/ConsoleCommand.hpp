#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// The maximum of bytes in a line of the console.
inline constexpr std::size_t MAX_CONSOLE_LINE = 4'095;

enum class EConsoleVerb : std::uint8_t
{
    Nothing, ///< An empty line.
    Plan,
    Cancel,
    Abort,
    Pause,
    Resume,
    Drop,
    List,
    Help,
    Quit,
};

/// A line of the console.
struct ConsoleCommand
{
    EConsoleVerb verb = EConsoleVerb::Nothing;
    std::string argument; ///< A file for Plan, a planId for Cancel, Abort, Pause and Resume.

    bool operator==(const ConsoleCommand&) const = default;
};

/// The error is one sentence for people.
[[nodiscard]] tl::expected<ConsoleCommand, std::string> ParseConsoleLine(std::string_view line);

/// Which lines there are, one per line of text.
[[nodiscard]] std::string_view GetConsoleHelp();

} // namespace ACS::McsSim

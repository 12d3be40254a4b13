#include "console/Screen.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view HIDE_CURSOR = "\x1b[?25l";
constexpr std::string_view SHOW_CURSOR = "\x1b[?25h";
constexpr std::string_view CLEAR_LINE_END = "\x1b[K";
constexpr std::string_view CLEAR_BELOW = "\x1b[J";
constexpr std::size_t MAX_SIZE = 1000;

/// Replaces the size by the value of the variable, if it is a valid number.
void TakeVariable(const char* name, std::size_t& size)
{
    const char* const textOrNull = std::getenv(name); // NOLINT(concurrency-mt-unsafe): one thread
    const std::string_view text = textOrNull == nullptr ? "" : textOrNull;
    const std::size_t value = Core::ParseNumberOrNull<std::size_t>(text).value_or(0);
    if (value > 0 && value <= MAX_SIZE)
    {
        size = value;
    }
}

/// Moves to the first of this number of lines above the cursor.
std::string MakeUp(std::size_t lines)
{
    return lines == 0 ? "\r" : fmt::format("\r\x1b[{}A", lines);
}

} // namespace

TerminalSize ReadTerminalSize()
{
    TerminalSize size;
    winsize window{};
    const bool bTerminal = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0; // NOLINT: the system's own signature
    if (bTerminal && window.ws_col > 0 && window.ws_row > 0)
    {
        size = {window.ws_col, window.ws_row};
    }
    TakeVariable("COLUMNS", size.columns);
    TakeVariable("LINES", size.rows);
    return size;
}

Screen::Screen(std::ostream& out, std::size_t columns)
    : _out(out),
      _columns(columns)
{
}

void Screen::Draw(const StyledLines& lines)
{
    // One write per frame, so that a terminal shows no half of it.
    std::string frame(HIDE_CURSOR);
    frame += MakeUp(_drawn);
    for (const StyledLine& line : lines)
    {
        // The last column stays free: some terminals wrap as soon as it is written.
        frame += MakeText(line, _columns - 1, true);
        frame += CLEAR_LINE_END;
        frame += '\n';
    }
    frame += CLEAR_BELOW;
    frame += SHOW_CURSOR;
    _out << frame << std::flush;
    _drawn = lines.size();
}

void Screen::Erase()
{
    if (_drawn > 0)
    {
        _out << MakeUp(_drawn) << CLEAR_BELOW << std::flush;
        _drawn = 0;
    }
}

void Screen::Leave() noexcept
{
    _drawn = 0;
}

} // namespace ACS::McsSim

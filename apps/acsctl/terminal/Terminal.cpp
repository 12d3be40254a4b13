#include "terminal/Terminal.hpp"

#include "view/DisplayText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iostream>
#include <sys/ioctl.h>
#include <sys/types.h>
#include <unistd.h>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t DEFAULT_COLUMNS = 80;
constexpr std::size_t DEFAULT_ROWS = 24;
constexpr std::size_t FEWEST_COLUMNS = 20;

struct Size
{
    std::size_t columns = DEFAULT_COLUMNS;
    std::size_t rows = DEFAULT_ROWS;
};

Size GetSize()
{
    if (::isatty(STDOUT_FILENO) != 1)
    {
        return {UNLIMITED_COLUMNS, DEFAULT_ROWS};
    }
    struct winsize size = {};
    const bool bKnown = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0; // NOLINT: the system's signature
    return bKnown && size.ws_col >= FEWEST_COLUMNS && size.ws_row > 1 ? Size{size.ws_col, size.ws_row} : Size();
}

} // namespace

Terminal::Terminal(bool bColorWanted, std::optional<std::size_t> columnsOrNull)
    : _bColored(bColorWanted && ::isatty(STDOUT_FILENO) == 1),
      _columnsOrNull(columnsOrNull)
{
}

Screen Terminal::GetScreen() const
{
    const std::size_t columns = std::max(_columnsOrNull.value_or(FEWEST_COLUMNS), FEWEST_COLUMNS);
    return {_columnsOrNull.has_value() ? columns : GetSize().columns, _bColored};
}

bool Terminal::CanAsk()
{
    return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1;
}

bool Terminal::IsTerminal()
{
    return ::isatty(STDOUT_FILENO) == 1;
}

bool Terminal::IsFailed() const noexcept
{
    return _bFailed;
}

void Terminal::Write(std::string_view text)
{
    while (!text.empty() && !_bFailed)
    {
        const ssize_t count = ::write(STDOUT_FILENO, text.data(), text.size());
        if (count >= 0)
        {
            text.remove_prefix(static_cast<std::size_t>(count));
        }
        else if (errno != EINTR)
        {
            _bFailed = true;
        }
    }
}

void Terminal::Redraw(const std::string& text)
{
    if (!IsTerminal())
    {
        Write(_bRedrawn ? "\n" + text : text);
        _bRedrawn = true;
        return;
    }
    const std::size_t rows = GetSize().rows;
    std::string out = _bRedrawn ? "\x1b[H" : "\x1b[H\x1b[2J";
    std::size_t row = 1;
    std::size_t start = 0;
    while (start < text.size() && row < rows)
    {
        const std::size_t end = text.find('\n', start);
        out.append(text, start, end == std::string::npos ? end : end - start).append("\x1b[K\n");
        start = end == std::string::npos ? text.size() : end + 1;
        ++row;
    }
    out += start < text.size() ? "…\x1b[K\x1b[J" : "\x1b[J";
    _bRedrawn = true;
    Write(out);
}

bool Terminal::IsConfirmed(const std::string& question)
{
    std::cerr << MakeDisplayable(question) << " [y/N] " << std::flush;
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "yes" || answer == "Y";
}

} // namespace ACS::Acsctl

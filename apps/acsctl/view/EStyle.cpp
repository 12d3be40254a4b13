#include "view/EStyle.hpp"

#include <algorithm>
#include <array>

namespace ACS::Acsctl
{

namespace
{

constexpr std::array<std::string_view, 6> CODES{"", "\x1b[1m", "\x1b[32m", "\x1b[33m", "\x1b[31m", "\x1b[2m"};
constexpr std::string_view RESET = "\x1b[0m";

constexpr std::array<std::string_view, 6> BAD{"Failed", "Aborted", "Error", "Disconnected", "heavy", "down"};
constexpr std::array<std::string_view, 8>
    WARNING{"Paused", "Pausing", "Stopped", "Manual", "Init", "light", "Cancelled", "Skipped"};
constexpr std::array<std::string_view, 4> GOOD{"Completed", "InProgress", "Auto", "up"};

} // namespace

std::string Paint(std::string_view text, EStyle style, bool bColored)
{
    const std::string_view code = CODES.at(static_cast<std::size_t>(style));
    if (!bColored || code.empty() || text.empty())
    {
        return std::string(text);
    }
    return std::string(code).append(text).append(RESET);
}

EStyle GetStyle(std::string_view status)
{
    const auto isIn = [status](const auto& words) {
        return std::ranges::find(words, status) != words.end();
    };
    if (isIn(BAD))
    {
        return EStyle::Bad;
    }
    if (isIn(WARNING))
    {
        return EStyle::Warning;
    }
    return isIn(GOOD) ? EStyle::Good : EStyle::Plain;
}

} // namespace ACS::Acsctl

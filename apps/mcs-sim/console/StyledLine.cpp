#include "console/StyledLine.hpp"

#include "console/CleanText.hpp"

#include <algorithm>
#include <cassert>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view RESET = "\x1b[0m";

std::string_view GetSequence(EStyle style)
{
    switch (style)
    {
        case EStyle::Plain:
            return "";
        case EStyle::Bold:
            return "\x1b[1m";
        case EStyle::Dim:
            return "\x1b[2m";
        case EStyle::Active:
            return "\x1b[36m";
        case EStyle::Good:
            return "\x1b[32m";
        case EStyle::Bad:
            return "\x1b[31m";
        default:
            assert(false);
            return "";
    }
}

} // namespace

std::string MakeText(const StyledLine& line, std::size_t columns, bool bStyled)
{
    // Spaces are held back until something follows them.
    std::string text;
    std::string spaces;
    std::size_t left = columns;
    for (const Span& span : line)
    {
        const std::string cut = CutText(span.text, left);
        left -= std::min(left, GetColumns(cut));
        const std::size_t begin = std::min(cut.find_first_not_of(' '), cut.size());
        const std::size_t end = cut.find_last_not_of(' ') + 1; // npos + 1 is 0
        spaces.append(begin, ' ');
        if (begin == cut.size())
        {
            continue;
        }
        const std::string_view sequence = bStyled ? GetSequence(span.style) : "";
        text += spaces;
        text += sequence;
        text.append(cut, begin, end - begin);
        text += sequence.empty() ? "" : RESET;
        spaces.assign(cut.size() - end, ' ');
    }
    return text;
}

} // namespace ACS::McsSim

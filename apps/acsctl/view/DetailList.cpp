#include "view/DetailList.hpp"

#include "view/DisplayText.hpp"

#include <algorithm>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t LABEL_GAP = 2;
constexpr std::size_t LEAST_VALUE = 20;

} // namespace

void DetailList::Add(std::string_view label, std::string_view value, EStyle style)
{
    _details.push_back({MakeDisplayable(label), MakeDisplayable(value), style});
}

void DetailList::AddIfAny(std::string_view label, std::string_view value, EStyle style)
{
    if (!value.empty())
    {
        Add(label, value, style);
    }
}

std::string DetailList::Print(const Screen& screen) const
{
    std::size_t labels = 0;
    for (const Detail& detail : _details)
    {
        labels = std::max(labels, CountColumns(detail.label));
    }
    const std::size_t indent = labels + LABEL_GAP;
    const std::size_t room = screen.columns > indent + LEAST_VALUE ? screen.columns - indent : LEAST_VALUE;
    std::string out;
    for (const Detail& detail : _details)
    {
        out += Paint(detail.label, EStyle::Title, screen.bColored);
        std::size_t blanks = indent - CountColumns(detail.label);
        for (const std::string& line : WrapText(detail.value, room))
        {
            if (!line.empty())
            {
                out.append(blanks, ' ');
                out += Paint(line, detail.style, screen.bColored);
            }
            out += '\n';
            blanks = indent;
        }
    }
    return out;
}

void AppendIndented(std::string& out, std::string_view text, std::size_t indent, const Screen& screen)
{
    const std::size_t room = screen.columns > indent + LEAST_VALUE ? screen.columns - indent : LEAST_VALUE;
    for (const std::string& line : WrapText(MakeDisplayable(text), room))
    {
        out.append(indent, ' ');
        out += line;
        out += '\n';
    }
}

} // namespace ACS::Acsctl

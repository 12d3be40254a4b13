#include "view/TextTable.hpp"

#include "view/DisplayText.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t GAP = 2;
constexpr std::size_t WIDEST_ALIGNED = 120;

} // namespace

TextTable::TextTable(std::vector<Column> columns)
    : _columns(std::move(columns))
{
}

void TextTable::AddRow(Row row)
{
    row.resize(_columns.size());
    for (Cell& cell : row)
    {
        cell.text = MakeDisplayable(cell.text);
    }
    _rows.push_back(std::move(row));
}

bool TextTable::IsEmpty() const noexcept
{
    return _rows.empty();
}

std::string TextTable::Print(const Screen& screen) const
{
    const std::vector<std::size_t> widths = ComputeWidths(screen.columns);
    std::string out;
    Row titles;
    for (const Column& column : _columns)
    {
        titles.push_back({column.title, EStyle::Title});
    }
    PrintRow(titles, widths, screen, out);
    for (const Row& row : _rows)
    {
        PrintRow(row, widths, screen, out);
    }
    return out;
}

std::vector<std::size_t> TextTable::ComputeWidths(std::size_t columns) const
{
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < _columns.size(); ++i)
    {
        std::size_t width = CountColumns(_columns[i].title);
        for (const Row& row : _rows)
        {
            width = std::max(width, CountColumns(row[i].text));
        }
        // One long cell must not fill all lines with blanks.
        width = columns == UNLIMITED_COLUMNS ? std::min(width, WIDEST_ALIGNED) : width;
        widths.push_back(width);
    }
    std::vector<std::size_t> order(_columns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t one, std::size_t other) {
        return _columns[one].rank > _columns[other].rank;
    });
    std::size_t used = std::accumulate(widths.begin(), widths.end(), GAP * (widths.empty() ? 0 : widths.size() - 1));
    // First to the minimum of each column, then further, where even that is too wide.
    for (const bool bLast : {false, true})
    {
        for (const std::size_t index : order)
        {
            const std::size_t minimum = bLast ? 1 : _columns[index].minimum;
            if (used > columns && widths[index] > minimum)
            {
                const std::size_t cut = std::min(used - columns, widths[index] - minimum);
                widths[index] -= cut;
                used -= cut;
            }
        }
    }
    return widths;
}

void TextTable::PrintRow(const Row& row, const std::vector<std::size_t>& widths, const Screen& screen, std::string& out)
    const
{
    std::size_t pending = 0; // blanks before the next text, so that no line ends in blanks
    for (std::size_t i = 0; i < row.size(); ++i)
    {
        const bool bWhole = screen.columns == UNLIMITED_COLUMNS;
        const std::string text = bWhole ? row[i].text : CutToColumns(row[i].text, widths[i]);
        const std::size_t blanks = widths[i] - std::min(CountColumns(text), widths[i]);
        pending += _columns[i].bRight ? blanks : 0;
        if (!text.empty())
        {
            out.append(pending, ' ');
            pending = 0;
            out += Paint(text, row[i].style, screen.bColored);
        }
        pending += (_columns[i].bRight ? 0 : blanks) + GAP;
    }
    out += '\n';
}

} // namespace ACS::Acsctl

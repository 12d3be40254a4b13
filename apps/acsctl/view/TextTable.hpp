#pragma once

#include "view/EStyle.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// Nothing is cut or continued on the next line.
constexpr std::size_t UNLIMITED_COLUMNS = std::numeric_limits<std::size_t>::max();

/// How a table or a text is shown.
struct Screen
{
    std::size_t columns = 80;
    bool bColored = false;
};

/// A table with a title for each column, in at most the columns of the screen. When the screen is too narrow, the cells of the
/// least important column are cut first. Without a limit, a column is at most 120 wide; the cells after a longer one move to the right.
class TextTable final
{
public:
    struct Column
    {
        std::string title;
        /// Of the columns, the one with the highest rank is cut first.
        int rank = 0;
        /// Columns that are left when it is cut.
        std::size_t minimum = 4;
        bool bRight = false; ///< Numbers.
    };

    struct Cell
    {
        std::string text; ///< Any text; Print makes it displayable.
        EStyle style = EStyle::Plain;
    };

    using Row = std::vector<Cell>;

private:
    std::vector<Column> _columns;
    std::vector<Row> _rows;

public:
    explicit TextTable(std::vector<Column> columns);

    /// One cell for each column; missing cells are empty.
    void AddRow(Row row);
    [[nodiscard]] bool IsEmpty() const noexcept;

    /// The lines of the table, each with its line end.
    [[nodiscard]] std::string Print(const Screen& screen) const;

private:
    [[nodiscard]] std::vector<std::size_t> ComputeWidths(std::size_t columns) const;
    void PrintRow(const Row& row, const std::vector<std::size_t>& widths, const Screen& screen, std::string& out) const;
};

} // namespace ACS::Acsctl

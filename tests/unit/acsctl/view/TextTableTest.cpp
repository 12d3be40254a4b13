#include "view/TextTable.hpp"

#include "Catch.hpp"
#include "view/DisplayText.hpp"

#include <cstddef>
#include <sstream>
#include <string>

namespace Acsctl = ACS::Acsctl;
using Acsctl::TextTable;

namespace
{

TextTable MakeTable()
{
    TextTable table({{"PLAN", 1}, {"AGE", 0, 3, true}, {"REASON", 2, 6}});
    table.AddRow({{"PLAN_1"}, {"7 s"}, {"No suitable robot is free."}});
    table.AddRow({{"계획_22"}, {"12 min"}, {"", Acsctl::EStyle::Bad}});
    return table;
}

} // namespace

TEST_CASE("The columns of a table are below their titles")
{
    CHECK(
        MakeTable().Print({80, false})
        == "PLAN        AGE  REASON\n"
           "PLAN_1      7 s  No suitable robot is free.\n"
           "계획_22  12 min\n");
}

TEST_CASE("The least important column is cut first")
{
    CHECK(
        MakeTable().Print({30, false})
        == "PLAN        AGE  REASON\n"
           "PLAN_1      7 s  No suitable …\n"
           "계획_22  12 min\n");
    CHECK(
        MakeTable().Print({20, false})
        == "PLAN     AGE  REASON\n"
           "PLA…     7 s  No su…\n"
           "계…   12 min\n");
}

TEST_CASE("No line of a table is wider than the screen")
{
    for (std::size_t columns = 7; columns < 60; ++columns)
    {
        std::istringstream lines(MakeTable().Print({columns, false}));
        for (std::string line; std::getline(lines, line);)
        {
            CAPTURE(columns, line);
            CHECK(Acsctl::CountColumns(line) <= columns);
            CHECK((line.empty() || line.back() != ' '));
        }
    }
}

TEST_CASE("Colours do not move the columns, and a cell cannot forge a line")
{
    TextTable table({{"A"}, {"B"}});
    table.AddRow({{"x\ny", Acsctl::EStyle::Bad}, {"z"}, {"more cells than columns"}});
    CHECK(table.Print({80, false}) == "A    B\nx y  z\n");
    CHECK(table.Print({80, true}) == "\x1b[1mA\x1b[0m    \x1b[1mB\x1b[0m\n\x1b[31mx y\x1b[0m  z\n");
}

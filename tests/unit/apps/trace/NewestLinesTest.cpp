#include "common/trace/NewestLines.hpp"

#include "Catch.hpp"

#include <string>

using ACS::Apps::NewestLines;

TEST_CASE("The newest lines are bounded in number and in bytes, but for a single long one")
{
    NewestLines lines(3, 10);
    CHECK(lines.GetText(5).empty());
    for (const char* line : {"a", "b", "c", "d"})
    {
        lines.Add(line);
    }
    CHECK(lines.GetText(5) == "b\nc\nd\n");
    CHECK(lines.GetText(2) == "c\nd\n");
    CHECK(lines.GetText(0).empty());
    lines.Add(std::string(9, 'x'));
    CHECK(lines.GetText(5) == "d\nxxxxxxxxx\n");
    lines.Add(std::string(11, 'y'));
    CHECK(lines.GetText(5) == std::string(11, 'y') + "\n");
    lines.Add("z");
    CHECK(lines.GetText(5) == "z\n");
}

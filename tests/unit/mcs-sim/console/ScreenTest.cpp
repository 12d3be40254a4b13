#include "console/Screen.hpp"

#include "Catch.hpp"

#include <sstream>

using ACS::McsSim::EStyle;
using ACS::McsSim::Screen;

TEST_CASE("A frame is drawn over the one before, and the cursor is visible after each")
{
    std::ostringstream out;
    Screen screen(out, 11);
    screen.Draw({{{"0123456789", EStyle::Plain}}, {{"two", EStyle::Plain}}});
    CHECK(out.str() == "\x1b[?25l\r0123456789\x1b[K\ntwo\x1b[K\n\x1b[J\x1b[?25h");
    out.str("");
    screen.Draw({{{"01234567890", EStyle::Plain}}});
    CHECK(out.str() == "\x1b[?25l\r\x1b[2A012345678…\x1b[K\n\x1b[J\x1b[?25h");
}

TEST_CASE("An erased frame leaves its place to others, a left one stays")
{
    std::ostringstream out;
    Screen screen(out, 80);
    screen.Erase();
    CHECK(out.str().empty());
    screen.Draw({{{"one", EStyle::Plain}}});
    out.str("");
    screen.Erase();
    CHECK(out.str() == "\r\x1b[1A\x1b[J");
    screen.Draw({{{"one", EStyle::Plain}}});
    screen.Leave();
    out.str("");
    screen.Erase();
    CHECK(out.str().empty());
}

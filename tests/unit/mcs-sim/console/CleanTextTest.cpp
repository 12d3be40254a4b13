#include "console/CleanText.hpp"

#include "Catch.hpp"
#include "console/StyledLine.hpp"

using ACS::McsSim::CleanText;
using ACS::McsSim::CutText;
using ACS::McsSim::EStyle;
using ACS::McsSim::FitRight;
using ACS::McsSim::FitText;
using ACS::McsSim::GetColumns;
using ACS::McsSim::MakeText;
using ACS::McsSim::StyledLine;

TEST_CASE("Control characters and invalid UTF-8 become question marks")
{
    CHECK(CleanText("a\tb\x1b[0m\n") == "a?b?[0m?");
    CHECK(CleanText("한글 – ok") == "한글 – ok");
    CHECK(CleanText("\xC3(\xED\xA0\x80\xFF") == "?(????");
    CHECK(CleanText("\xC2\x9B") == "?");
    CHECK(CleanText("\xE2\x82") == "??");
    CHECK(CleanText(std::string{'\xE2', '\x80', '\xAE'}) == "?");
}

TEST_CASE("Columns are counted as a terminal does")
{
    CHECK(GetColumns("abc") == 3);
    CHECK(GetColumns("–█…") == 3);
    CHECK(GetColumns("한글") == 4);
}

TEST_CASE("Text is truncated at a character, with an ellipsis")
{
    CHECK(FitText("abc", 5) == "abc  ");
    CHECK(FitText("abcdef", 4) == "abc…");
    CHECK(FitText("한글한글", 4) == "한… ");
    CHECK(CutText("abc", 3) == "abc");
    CHECK(CutText("abc", 1) == "…");
    CHECK(CutText("abc", 0).empty());
    CHECK(FitRight("7", 3) == "  7");
}

TEST_CASE("A line ends at the last column, and its styles do not count")
{
    const StyledLine line{{"ab ", EStyle::Good}, {"cdef  ", EStyle::Plain}};
    CHECK(MakeText(line, 80, false) == "ab cdef");
    CHECK(MakeText(line, 80, true) == "\x1b[32mab\x1b[0m cdef");
    CHECK(MakeText(line, 5, false) == "ab c…");
    CHECK(MakeText({}, 5, true).empty());
}

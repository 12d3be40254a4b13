#include "view/DisplayText.hpp"

#include "Catch.hpp"

#include <string>
#include <vector>

namespace Acsctl = ACS::Acsctl;

TEST_CASE("A wide character occupies two columns, a combining mark none")
{
    CHECK(Acsctl::CountColumns("LR01") == 4);
    CHECK(Acsctl::CountColumns("로봇") == 4);
    CHECK(Acsctl::CountColumns("日本") == 4);
    CHECK(Acsctl::CountColumns("é") == 1);
    CHECK(Acsctl::CountColumns("e\u0301") == 1);
    CHECK(Acsctl::CountColumns("🤖") == 2);
    CHECK(Acsctl::CountColumns("…") == 1);
    CHECK(Acsctl::CountColumns("") == 0);
}

TEST_CASE("A text is cut between characters and never exceeds its columns")
{
    CHECK(Acsctl::CutToColumns("LR01", 4) == "LR01");
    CHECK(Acsctl::CutToColumns("LR01.CP01", 4) == "LR0…");
    CHECK(Acsctl::CutToColumns("로봇정지", 8) == "로봇정지");
    CHECK(Acsctl::CutToColumns("로봇정지", 7) == "로봇정…");
    CHECK(Acsctl::CutToColumns("로봇정지", 6) == "로봇…");
    CHECK(Acsctl::CutToColumns("로봇", 1) == "…");
    CHECK(Acsctl::CutToColumns("로봇", 0).empty());
}

TEST_CASE("What a peer sent cannot control the terminal")
{
    CHECK(Acsctl::MakeDisplayable("a\x1b[2J\x07\x7f") == "a\\x1b[2J\\x07\\x7f");
    CHECK(Acsctl::MakeDisplayable("a\nb\tc\r") == "a b c\\x0d");
    CHECK(Acsctl::MakeDisplayable("\u009b31m") == "\\x9b31m");
    CHECK(Acsctl::MakeDisplayable(std::string("\xE2\x80") + "\xAEgnp") == "\\u202egnp"); // from right to left
    CHECK(Acsctl::MakeDisplayable("로봇 é") == "로봇 é");
    CHECK(Acsctl::MakeDisplayable(std::string("a\xff\xc3", 3)) == "a\uFFFD\uFFFD");
    CHECK(Acsctl::MakeDisplayable("\xc0\x80\xed\xa0\x80\xf5\x80\x80\x80").find('\x80') != 0);
    CHECK(Acsctl::MakeDisplayable(std::string(1, '\0')) == "\\x00");
}

TEST_CASE("JSON keeps its value when what could control the terminal is escaped")
{
    CHECK(
        // NOLINTNEXTLINE(misc-misleading-bidirectional): what is tested
        Acsctl::MakeDisplayableJSON("{\"a\":\t\"\u009b1\x7f\u202e로봇\"}")
        == "{\"a\":\t\"\\u009b1\\u007f\\u202e로봇\"}");
    CHECK(Acsctl::MakeDisplayableJSON("\"\U000E0041🤖\"") == "\"\\udb40\\udc41🤖\"");
}

TEST_CASE("A long text continues on the next line, at a space if there is one")
{
    using Lines = std::vector<std::string>;
    CHECK(Acsctl::WrapText("", 10) == Lines{""});
    CHECK(Acsctl::WrapText("one two three", 7) == Lines{"one two", "three"});
    CHECK(Acsctl::WrapText("one two three", 8) == Lines{"one two", "three"});
    CHECK(Acsctl::WrapText("abcdefgh", 3) == Lines{"abc", "def", "gh"});
    CHECK(Acsctl::WrapText("로봇이 정지", 6) == Lines{"로봇이", "정지"});
    CHECK(Acsctl::WrapText("로봇", 0) == Lines{"로", "봇"});
}

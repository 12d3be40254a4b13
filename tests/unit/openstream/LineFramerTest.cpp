#include "LineFramer.hpp"

#include "Catch.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace
{

using ACS::OpenStream::LineFramer;

std::vector<std::string> TakeLines(LineFramer& framer, std::string_view bytes)
{
    std::vector<std::string> lines;
    framer.Feed(bytes);
    while (const auto line = framer.TakeLineOrNull())
    {
        lines.emplace_back(*line);
    }
    framer.Keep();
    return lines;
}

} // namespace

TEST_CASE("1 Every split of the received bytes gives the same lines")
{
    const std::string text = "{\"a\":1}\n\r\n  \n{\"b\":2}\r\n{\"c\":3}\n";
    const std::vector<std::string> expected{"{\"a\":1}", "{\"b\":2}", "{\"c\":3}"};
    for (std::size_t first = 0; first <= text.size(); ++first)
    {
        for (std::size_t second = first; second <= text.size(); ++second)
        {
            LineFramer framer(64);
            std::vector<std::string> lines;
            for (const std::string& part :
                 {text.substr(0, first), text.substr(first, second - first), text.substr(second)})
            {
                for (std::string& line : TakeLines(framer, part))
                {
                    lines.push_back(std::move(line));
                }
            }
            REQUIRE(lines == expected);
            REQUIRE_FALSE(framer.HasPartialLine());
        }
    }
}

TEST_CASE("1 A line that is complete in the input is not copied")
{
    LineFramer framer(64);
    const std::string text = "first\nsecond\n";
    framer.Feed(text);
    REQUIRE(framer.TakeLineOrNull()->data() == text.data());
    REQUIRE(framer.TakeLineOrNull()->data() == text.data() + 6);
}

TEST_CASE("7.20 A line of the maximum length is accepted; one byte more is an overflow and ends the stream")
{
    LineFramer framer(8);
    REQUIRE(TakeLines(framer, "12345678\n").size() == 1);
    REQUIRE(TakeLines(framer, "abc\n123456789\nabc\n") == std::vector<std::string>{"abc"});
    REQUIRE(framer.HasOverflown());
    REQUIRE(TakeLines(framer, "abc\n").empty());
    framer.Reset();
    REQUIRE(TakeLines(framer, "abc\n").size() == 1);
}

TEST_CASE("7.20 A line without end is an overflow as soon as it is too long, in any number of pieces")
{
    LineFramer framer(8);
    REQUIRE(TakeLines(framer, "1234").empty());
    REQUIRE(TakeLines(framer, "5678").empty());
    REQUIRE_FALSE(framer.HasOverflown());
    REQUIRE(TakeLines(framer, "9").empty());
    REQUIRE(framer.HasOverflown());
    REQUIRE(TakeLines(framer, "abc\nabc\n").empty());
    framer.Reset();
    REQUIRE_FALSE(framer.HasPartialLine());
}

TEST_CASE("7.20 Unread lines are kept in order and are no overflow")
{
    LineFramer framer(8);
    framer.Feed("one\ntwo\nthree\nfo");
    REQUIRE(*framer.TakeLineOrNull() == "one");
    framer.Keep();
    REQUIRE_FALSE(framer.HasOverflown());
    REQUIRE(TakeLines(framer, "ur\n") == std::vector<std::string>{"two", "three", "four"});
}

#include "events/SseParser.hpp"

#include "Catch.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace Acsctl = ACS::Acsctl;

namespace
{

/// "type|id|data" of each event, read in parts of this size.
std::vector<std::string> ReadAll(const std::string& text, std::size_t part)
{
    Acsctl::SseParser parser;
    std::vector<Acsctl::SseEvent> events;
    for (std::size_t at = 0; at < text.size(); at += part)
    {
        REQUIRE(parser.TryRead(std::string_view(text).substr(at, part), events));
    }
    std::vector<std::string> out;
    out.reserve(events.size());
    for (const Acsctl::SseEvent& event : events)
    {
        out.push_back(event.type + "|" + event.id + "|" + event.data);
    }
    return out;
}

using Texts = std::vector<std::string>;

} // namespace

TEST_CASE("Events do not depend on the parts in which they arrive")
{
    const std::string text = "\xEF\xBB\xBF: keep-alive\n\nevent: entry\nid: 7\ndata: {}\n\n"
                             "event: changes\r\nid: 8\r\ndata: a\r\ndata:b\r\n\r\nretry: 5\rdata\r\rdata: cut";
    for (std::size_t part = 1; part <= text.size(); ++part)
    {
        CAPTURE(part);
        CHECK(ReadAll(text, part) == Texts{"entry|7|{}", "changes|8|a\nb", "message|8|"});
    }
}

TEST_CASE("Lines without a meaning are ignored")
{
    CHECK(ReadAll("event: x\n\n", 99).empty());
    CHECK(ReadAll("odd: 1\n:\nid\ndata:  two\n\n", 99) == Texts{"message|| two"});
    CHECK(ReadAll(std::string("id: a\0b\ndata: 1\n\n", 17), 99) == Texts{"message||1"});
}

TEST_CASE("A stream without an end of line is refused")
{
    Acsctl::SseParser parser;
    std::vector<Acsctl::SseEvent> events;
    const std::string part(1'000'000, 'x');
    bool bRead = true;
    for (std::size_t i = 0; bRead && i < 100; ++i)
    {
        bRead = parser.TryRead(part, events);
    }
    CHECK_FALSE(bRead);
}

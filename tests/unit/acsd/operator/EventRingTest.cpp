#include "operator/EventRing.hpp"

#include "Catch.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

using ACS::Acsd::EventRing;

namespace
{

constexpr std::size_t MUCH = 1'000'000;

} // namespace

TEST_CASE("An event has its type, a number and its data; a line break does not end it")
{
    EventRing ring(100, {});
    CHECK(ring.Add("entry", "{}") == 101);
    CHECK(ring.Add("changes", "{\n\"a\":1}") == 102);
    CHECK(ring.GetLastID() == 102);
    std::uint64_t position = 100;
    CHECK(
        ring.TakeAfter(position, MUCH)
        == "event: entry\nid: 101\ndata: {}\n\nevent: changes\nid: 102\ndata: {\ndata: \"a\":1}\n\n");
    CHECK(position == 102);
    CHECK(ring.TakeAfter(position, MUCH).empty());
}

TEST_CASE("Only events of this run that are still known can be continued")
{
    EventRing ring(100, {3, MUCH});
    CHECK(ring.HasAllAfter(100));
    CHECK_FALSE(ring.HasAllAfter(99));
    CHECK_FALSE(ring.HasAllAfter(101));
    for (int count = 0; count < 5; ++count)
    {
        ring.Add("entry", "{}");
    }
    CHECK_FALSE(ring.HasAllAfter(101));
    CHECK(ring.HasAllAfter(102));
    CHECK(ring.HasAllAfter(105));
    CHECK_FALSE(ring.HasAllAfter(106));
    CHECK_FALSE(ring.HasAllAfter(0));
    CHECK_FALSE(ring.HasAllAfter(UINT64_MAX));
    std::uint64_t position = 102;
    CHECK(ring.TakeAfter(position, MUCH).starts_with("event: entry\nid: 103\n"));
    CHECK(position == 105);
}

TEST_CASE("Events are bounded in bytes, and taken in pieces; a longer one is kept and taken alone")
{
    EventRing ring(0, {1'000, 300});
    for (int count = 0; count < 10; ++count)
    {
        ring.Add("entry", std::string(100, 'x')); // 100 bytes and some more for its header
    }
    CHECK(ring.HasAllAfter(8));
    CHECK_FALSE(ring.HasAllAfter(7));
    std::uint64_t position = 8;
    CHECK(std::ranges::count(ring.TakeAfter(position, 1), 'x') == 100);
    CHECK(position == 9);
    ring.Add("entry", std::string(1'000, 'z'));
    CHECK(ring.HasAllAfter(10));
    CHECK_FALSE(ring.HasAllAfter(9));
    position = 10;
    CHECK(std::ranges::count(ring.TakeAfter(position, 300), 'z') == 1'000);
}

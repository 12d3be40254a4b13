#include "common/trace/TraceQueue.hpp"

#include "Catch.hpp"

#include <string>

namespace ACS::Testing
{

TEST_CASE("TraceQueue: the entry after lost lines states their number; the memory is free when the entries are taken")
{
    Apps::TraceQueue queue(1'000);
    const std::string half(450, 'x');
    CHECK(queue.TryPush(half, {}));
    CHECK_FALSE(queue.TryPush(half, {}));
    CHECK_FALSE(queue.TryPush(half, {}));
    CHECK(queue.TryPush("short", {}));
    CHECK_FALSE(queue.HasLost());
    const Apps::TraceQueue::Entries entries = queue.TakeEntries();
    REQUIRE(entries.size() == 2);
    CHECK(entries[0].lostBefore == 0);
    CHECK(entries[1].lostBefore == 2);
    CHECK(queue.IsEmpty());
    CHECK(queue.TryPush(half, {}));
}

TEST_CASE("TraceQueue: lost lines that were taken are not stated again")
{
    Apps::TraceQueue queue(200);
    CHECK_FALSE(queue.TryPush(std::string(200, 'x'), {}));
    CHECK(queue.HasLost());
    CHECK(queue.IsEmpty());
    CHECK(queue.TakeLost() == 1);
    REQUIRE(queue.TryPush("short", {}));
    CHECK(queue.TakeEntries().front().lostBefore == 0);
}

} // namespace ACS::Testing

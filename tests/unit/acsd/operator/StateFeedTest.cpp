#include "operator/StateFeed.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "ManualClock.hpp"

#include <boost/asio/io_context.hpp>

#include <cstdint>

namespace ACS::Acsd::Test
{

TEST_CASE("Reading the state publishes nothing; an update publishes what differs from the last one, once")
{
    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::PlanWorld world{1, true};
    EventFeed events(clock, [] {});
    ProgramState program;
    program.links = {{"mcs", true}};
    StateFeed feed({context.get_executor(), clock, *world.engine, [&program] { return program; }, events});

    static_cast<void>(feed.Update());
    const std::uint64_t first = events.GetLastID();
    CHECK(feed.GetEventID() == first);
    program.links[0].bUp = false;
    for (int count = 0; count < 10; ++count)
    {
        CHECK_FALSE(feed.Read().status.links[0].bUp);
    }
    CHECK(events.GetLastID() == first);
    CHECK_FALSE(feed.Update().status.links[0].bUp);
    CHECK(events.GetLastID() == first + 1);
    static_cast<void>(feed.Update());
    CHECK(events.GetLastID() == first + 1);
}

} // namespace ACS::Acsd::Test

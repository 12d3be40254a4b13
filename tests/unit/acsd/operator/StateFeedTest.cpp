#include "operator/StateFeed.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "ManualClock.hpp"

#include <boost/asio/io_context.hpp>

#include <cstdint>
#include <string>

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

TEST_CASE("A plan that begins and ends between two updates has ended in the next event, and in no later one")
{
    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::PlanWorld world{1, true};
    EventFeed events(clock, [] {});
    StateFeed feed({context.get_executor(), clock, *world.engine, [] { return ProgramState(); }, events});
    world.engine->AddObserver(feed.GetObserver());

    static_cast<void>(feed.Update());
    Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/events");
    request.bCanStream = true;
    const Apps::HttpResponse stream = events.Respond(request);
    world.Submit(Testing::MakeLogisticsPlan("P1"));
    world.Control(Planning::EPlanControl::Cancel, "P1");
    REQUIRE(Testing::Contains(world.GetReportsOf("P1"), "Plan Cancelled"));
    static_cast<void>(feed.Update());
    const std::string sent = stream.stream->TakeNext();
    CHECK(sent.find(R"("ended":[{"planId":"P1")") != std::string::npos);
    CHECK(sent.find(R"("ended")") == sent.rfind(R"("ended")"));
    static_cast<void>(feed.Update());
    CHECK(stream.stream->TakeNext().find(R"("ended")") == std::string::npos);
}

TEST_CASE("A plan that has ended is in the next event also if the engine keeps no record of it")
{
    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::PlanWorld world =
        Testing::MakeWorld([](Planning::EngineOptions& options) { options.finishedPlansKept = 0; });
    EventFeed events(clock, [] {});
    StateFeed feed({context.get_executor(), clock, *world.engine, [] { return ProgramState(); }, events});
    world.engine->AddObserver(feed.GetObserver());
    for (const char* planID : {"P1", "P2"})
    {
        world.Submit(Testing::MakeLogisticsPlan(planID));
    }
    static_cast<void>(feed.Update());

    Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/events");
    request.bCanStream = true;
    const Apps::HttpResponse stream = events.Respond(request);
    for (const char* planID : {"P1", "P2"})
    {
        world.Control(Planning::EPlanControl::Cancel, planID);
        REQUIRE(Testing::TryRunUntil(world, planID, "Plan Cancelled"));
    }
    REQUIRE(world.engine->GetPlanRecordOrNull("P1") == nullptr);
    static_cast<void>(feed.Update());
    const std::string sent = stream.stream->TakeNext();
    CHECK(sent.find(R"("ended":[{"planId":"P1")") != std::string::npos);
    CHECK(sent.find(R"("status":"Cancelled")") != std::string::npos);
}

} // namespace ACS::Acsd::Test

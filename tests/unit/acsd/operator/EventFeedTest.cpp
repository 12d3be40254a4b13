#include "operator/EventFeed.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <cstdint>
#include <optional>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::EventFeed;

namespace
{

struct FeedFixture
{
    Testing::ManualClock clock;
    int flushRequests = 0;
    EventFeed feed{clock, [this] { ++flushRequests; }, {3, 1'000'000}};

    Apps::HttpResponse Ask(const std::string& query, const std::optional<std::string>& lastEventIdOrNull = std::nullopt)
    {
        Apps::HttpRequest request = *Apps::ParseHttpTarget("/v1/events" + query);
        request.method = "GET";
        request.bCanStream = true;
        if (lastEventIdOrNull.has_value())
        {
            request.headers = {{"last-event-id", *lastEventIdOrNull}};
        }
        return feed.Respond(request);
    }

    Apps::HttpResponse AskAfter(std::uint64_t eventID)
    {
        return Ask("?after=" + std::to_string(eventID));
    }
};

} // namespace

TEST_CASE("A client gets the events from now on, or those after the one that it had last")
{
    FeedFixture fixture;
    const std::uint64_t first = fixture.feed.Publish("entry", "1");
    CHECK(fixture.feed.GetLastID() == first);
    const Apps::HttpResponse fromNow = fixture.Ask("");
    CHECK(fromNow.status == 200);
    CHECK(fromNow.contentType == "text/event-stream");
    CHECK(fromNow.headers == Apps::HttpHeaders{{"Cache-Control", "no-store"}});
    CHECK(fromNow.stream->TakeNext() == "retry: 2000\n\n");
    CHECK(fromNow.stream->TakeNext().empty());
    const std::string event = "event: entry\nid: " + std::to_string(first) + "\ndata: 1\n\n";
    CHECK(fixture.AskAfter(first - 1).stream->TakeNext() == "retry: 2000\n\n" + event);
    // The header of a browser that connects again is newer than its address.
    CHECK(fixture.Ask("?after=5", std::to_string(first)).stream->TakeNext() == "retry: 2000\n\n");
    fixture.feed.Publish("entry", "2");
    CHECK(fromNow.stream->TakeNext() == "event: entry\nid: " + std::to_string(first + 1) + "\ndata: 2\n\n");
}

TEST_CASE("A client whose events are lost gets reset, and continues with later ones")
{
    FeedFixture fixture;
    const std::uint64_t first = fixture.feed.Publish("entry", "1");
    const Apps::HttpResponse slow = fixture.AskAfter(first);
    CHECK(slow.stream->TakeNext() == "retry: 2000\n\n");
    const Apps::HttpResponse earlierRun = fixture.AskAfter(7);
    const Apps::HttpResponse future = fixture.AskAfter(first + 1'000);
    CHECK(earlierRun.stream->TakeNext() == "retry: 2000\n\nevent: reset\ndata: {}\n\n");
    CHECK(future.stream->TakeNext() == "retry: 2000\n\nevent: reset\ndata: {}\n\n");
    for (int count = 0; count < 4; ++count)
    {
        fixture.feed.Publish("entry", "2");
    }
    CHECK(slow.stream->TakeNext() == "event: reset\ndata: {}\n\n");
    CHECK(slow.stream->TakeNext().empty());
    fixture.feed.Publish("entry", "3");
    CHECK(slow.stream->TakeNext().ends_with("data: 3\n\n"));
}

TEST_CASE("The events of a later run have other numbers")
{
    FeedFixture fixture;
    const std::uint64_t last = fixture.feed.Publish("entry", "1");
    CHECK(last == 1'751'457'600'000'001);
    fixture.clock.Advance(std::chrono::milliseconds(1));
    EventFeed later(fixture.clock, [] {});
    CHECK(later.GetLastID() > last);
}

TEST_CASE("An invalid position is answered with 400, and a stream beyond the limit with 503")
{
    FeedFixture fixture;
    for (const char* query :
         {"?after=",
          "?after=x",
          "?after=-1",
          "?after=1x",
          "?after=99999999999999999999",
          "?after=1&after=2",
          "?other=1"})
    {
        CAPTURE(query);
        const Apps::HttpResponse response = fixture.Ask(query);
        CHECK(response.status == 400);
        CHECK(response.body.starts_with("{\"error\":\""));
        CHECK(response.stream == nullptr);
    }
    CHECK(fixture.Ask("", "x").status == 400);
    CHECK(fixture.Ask("", "").status == 400);
    const Apps::HttpResponse refused = fixture.feed.Respond(*Apps::ParseHttpTarget("/v1/events"));
    CHECK(refused.status == 503);
    CHECK(refused.retryAfter.count() > 0);
}

TEST_CASE("Events that are published together are flushed together, and only if there is a client")
{
    int notified = 0; // outlives the feed, which ends its streams
    FeedFixture fixture;
    fixture.feed.Publish("entry", "1");
    CHECK(fixture.flushRequests == 0);
    const Apps::HttpResponse response = fixture.Ask("");
    response.stream->Attach([&notified] { ++notified; });
    fixture.feed.Publish("entry", "2");
    fixture.feed.Publish("entry", "3");
    CHECK(fixture.flushRequests == 1);
    CHECK(notified == 0);
    fixture.feed.Flush();
    CHECK(notified == 1);
    fixture.feed.Publish("entry", "4");
    CHECK(fixture.flushRequests == 2);
}

TEST_CASE("A client without events gets a comment, and its stream ends after an hour or when all end")
{
    FeedFixture fixture;
    const Apps::HttpResponse response = fixture.Ask("");
    CHECK(response.stream->TakeNext() == "retry: 2000\n\n");
    fixture.feed.KeepAlive();
    CHECK(response.stream->TakeNext() == ": keep-alive\n\n");
    CHECK(response.stream->TakeNext().empty());
    fixture.clock.Advance(EventFeed::LONGEST_STREAM);
    const Apps::HttpResponse second = fixture.Ask("");
    fixture.feed.KeepAlive();
    CHECK_FALSE(response.stream->IsOpen());
    CHECK(second.stream->IsOpen());
    fixture.feed.EndAll();
    CHECK_FALSE(second.stream->IsOpen());
}

#include "common/trace/TraceQuery.hpp"

#include "Catch.hpp"
#include "common/http/HttpPendingResponse.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"
#include "trace/MessageTrace.hpp"
#include "trace/TraceRoute.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace ACS::Acsd::Test
{

namespace
{

using ProtocolBeast::EWireDirection;

struct QueryFixture
{
    Testing::TemporaryFolder folder;
    Testing::ManualClock clock;
    std::unique_ptr<MessageTrace> trace = Begin();

    [[nodiscard]] std::unique_ptr<MessageTrace> Begin() const
    {
        auto created = MessageTrace::Create(folder.GetPath().string(), {}, clock, Core::Logger());
        REQUIRE(created.has_value());
        (*created)->Keep();
        return std::move(*created);
    }

    [[nodiscard]] std::string Find(const Apps::TraceQuery& query) const
    {
        return trace->MakeSearch(query, 1'000)().GetText(1'000);
    }
};

struct Loop
{
    boost::asio::io_context context;
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> guard{context.get_executor()};

    /// Runs until the response is complete.
    Apps::HttpResponse Complete(Apps::HttpResponse response)
    {
        if (response.pending != nullptr)
        {
            bool bComplete = false;
            response.pending->Attach([&response, &bComplete](const Apps::HttpResponse& complete) {
                response = complete;
                bComplete = true;
            });
            while (!bComplete)
            {
                context.run_one();
            }
        }
        return response;
    }
};

} // namespace

TEST_CASE_METHOD(QueryFixture, "A message of the MCS is found by its plan, its robot and its transaction")
{
    trace->Write(
        {"mcs",
         EWireDirection::Out,
         {},
         {},
         R"({"command":"JobReport","transactionId":"T1","payload":{"planId":"P1","robotId":"LR01"}})"});
    CHECK_FALSE(Find({"P1", {}, {}}).empty());
    CHECK_FALSE(Find({{}, "LR01", {}}).empty());
    CHECK_FALSE(Find({{}, {}, "T1"}).empty());
    CHECK_FALSE(Find({"P1", "LR01", "T1"}).empty());
    CHECK(Find({"P2", {}, {}}).empty());
    CHECK(Find({"P1", "LR02", {}}).empty());
}

TEST_CASE_METHOD(QueryFixture, "A message of a robot is found by the plan that the robot has")
{
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "before"});
    trace->SetPlan("LR01", "P1");
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "within"});
    trace->Write({"mqtt", EWireDirection::In, "LR02", "t", "other"});
    trace->SetPlan("LR01", {});
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "after"});
    const std::string found = Find({"P1", {}, {}});
    CHECK(found.find("within") != std::string::npos);
    CHECK(found.find("before") == std::string::npos);
    CHECK(found.find("other") == std::string::npos);
    CHECK(found.find("after") == std::string::npos);
}

TEST_CASE_METHOD(QueryFixture, "Lines of an earlier run are found in the files, those of a replay are not")
{
    trace->SetPlan("LR01", "P1");
    trace->Write({"arm", EWireDirection::In, "LR01", {}, "first run"});
    trace->Add({"core", EWireDirection::In, "LR01", {}, "input", "robot", "P1"}, ETraceUse::FilesOnly);
    trace.reset();
    clock.Advance(std::chrono::seconds(1));
    trace = Begin();
    trace->SetPlan("LR01", "P1");
    trace->Write({"arm", EWireDirection::In, "LR01", {}, "second run"});
    const std::string found = Find({"P1", {}, {}});
    const std::size_t first = found.find("first run");
    const std::size_t second = found.find("second run");
    REQUIRE(first != std::string::npos);
    REQUIRE(second != std::string::npos);
    CHECK(first < second);
    CHECK(found.find("input") == std::string::npos);
}

TEST_CASE_METHOD(QueryFixture, "When the wall clock is set back, all lines are found, and each once")
{
    trace->SetPlan("LR01", "P1");
    trace->Write({"arm", EWireDirection::In, "LR01", {}, "first"});
    trace.reset();
    clock.Advance(std::chrono::seconds(1));
    clock.JumpWall(-std::chrono::hours(1));
    trace = Begin();
    trace->SetPlan("LR01", "P1");
    trace->Write({"arm", EWireDirection::In, "LR01", {}, "second"});
    clock.Advance(std::chrono::seconds(1));
    clock.JumpWall(-std::chrono::hours(1));
    trace->Write({"arm", EWireDirection::In, "LR01", {}, "third"});
    const MessageTrace::LineSearch search = trace->MakeSearch({"P1", {}, {}}, 9);
    trace.reset(); // which writes the lines
    const std::string found = search().GetText(9);
    const std::size_t first = found.find("first");
    const std::size_t second = found.find("second");
    const std::size_t third = found.find("third");
    REQUIRE(third != std::string::npos);
    CHECK(first < second);
    CHECK(second < third);
    CHECK(found.find("third", third + 1) == std::string::npos);
}

TEST_CASE_METHOD(QueryFixture, "GET /v1/trace has the lines that match its parameters, and refuses unknown ones")
{
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "one"});
    trace->Write({"mqtt", EWireDirection::In, "LR02", "t", "two"});
    Loop loop;
    TraceRoute route(loop.context.get_executor(), trace.get());
    const auto get = [&](const std::string& target) {
        return loop.Complete(route.Respond(*Apps::ParseHttpTarget(target)));
    };
    const std::string found = get("/v1/trace?robot=LR02&limit=5").body;
    CHECK(found.find("two") != std::string::npos);
    CHECK(found.find("one") == std::string::npos);
    CHECK(get("/v1/trace?plan=P1").body.empty());
    CHECK(get("/v1/trace").body.find("one") != std::string::npos);
    for (const char* target :
         {"/v1/trace?robots=LR02", "/v1/trace?robot=LR01&robot=LR02", "/v1/trace?robot=LR01&limit=0"})
    {
        CAPTURE(target);
        const Apps::HttpResponse refusal = route.Respond(*Apps::ParseHttpTarget(target));
        CHECK(refusal.status == 400);
        CHECK(refusal.pending == nullptr);
    }
}

TEST_CASE_METHOD(QueryFixture, "A search does not block the loop; a further one is refused until it has ended")
{
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "one"});
    Loop loop;
    TraceRoute route(loop.context.get_executor(), trace.get());
    const Apps::HttpRequest search = *Apps::ParseHttpTarget("/v1/trace?robot=LR01");
    const Apps::HttpResponse first = route.Respond(search);
    REQUIRE(first.pending != nullptr);
    for (int i = 0; i < 3; ++i)
    {
        const Apps::HttpResponse busy = route.Respond(search);
        CHECK(busy.status == 503);
        CHECK(busy.retryAfter == std::chrono::seconds(1));
        CHECK(busy.body.starts_with("{\"error\":\""));
    }
    CHECK(route.Respond(*Apps::ParseHttpTarget("/v1/trace")).status == 200);
    CHECK(loop.Complete(first).body.find("one") != std::string::npos);
    CHECK(loop.Complete(route.Respond(search)).body.find("one") != std::string::npos);
}

TEST_CASE_METHOD(QueryFixture, "A search that runs when its route ends is dropped")
{
    Loop loop;
    {
        TraceRoute route(loop.context.get_executor(), trace.get());
        CHECK(route.Respond(*Apps::ParseHttpTarget("/v1/trace?plan=P1")).pending != nullptr);
    }
    loop.guard.reset();
    CHECK(loop.context.run() == 1);
}

TEST_CASE_METHOD(QueryFixture, "A search ends with the newest lines that were demanded")
{
    trace->SetPlan("LR01", "P1");
    for (const char* text : {"one", "two", "three"})
    {
        trace->Write({"mqtt", EWireDirection::In, "LR01", "t", text});
    }
    const std::string found = trace->MakeSearch({"P1", {}, {}}, 2)().GetText(9);
    CHECK(found.find("one") == std::string::npos);
    CHECK(found.find("two") < found.find("three"));
}

TEST_CASE("Without a trace GET /v1/trace is answered with 404")
{
    Loop loop;
    TraceRoute route(loop.context.get_executor(), nullptr);
    CHECK(route.Respond(*Apps::ParseHttpTarget("/v1/trace?plan=P1")).status == 404);
}

TEST_CASE("A text that looks like a member is no match")
{
    const std::string line = R"({"time":"T","link":"mcs","plan":"P2","text":"x,\"plan\":\"P1\""})";
    CHECK_FALSE(Apps::TraceQuery{"P1", {}, {}}.IsMatch(line));
    CHECK(Apps::TraceQuery{"P2", {}, {}}.IsMatch(line));
}

} // namespace ACS::Acsd::Test

#include "common/trace/TraceQuery.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"
#include "trace/MessageTrace.hpp"
#include "trace/TraceRoute.hpp"

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
        return std::move(*created);
    }

    [[nodiscard]] std::string Find(const Apps::TraceQuery& query) const
    {
        return trace->Find(query, 1'000).GetText(1'000);
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

TEST_CASE_METHOD(QueryFixture, "GET /v1/trace has the lines that match its parameters, and refuses unknown ones")
{
    trace->Write({"mqtt", EWireDirection::In, "LR01", "t", "one"});
    trace->Write({"mqtt", EWireDirection::In, "LR02", "t", "two"});
    const auto get = [this](const std::string& target) {
        return RespondWithTrace(*Apps::ParseHttpTarget(target), *trace);
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
        CHECK(get(target).status == 400);
    }
}

TEST_CASE("A text that looks like a member is no match")
{
    const std::string line = R"({"time":"T","link":"mcs","plan":"P2","text":"x,\"plan\":\"P1\""})";
    CHECK_FALSE(Apps::TraceQuery{"P1", {}, {}}.IsMatch(line));
    CHECK(Apps::TraceQuery{"P2", {}, {}}.IsMatch(line));
}

} // namespace ACS::Acsd::Test

#include "trace/MessageTrace.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "FullDisk.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"
#include "trace/ArmTrace.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using ProtocolBeast::EWireDirection;
using Testing::FullDisk;
using Testing::ReadLines;

struct TraceFixture
{
    Testing::TemporaryFolder folder;
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;

    [[nodiscard]] std::unique_ptr<MessageTrace> Begin(std::size_t queueBytes = Apps::TraceWriter::DEFAULT_QUEUE_BYTES)
    {
        auto trace =
            MessageTrace::Create(folder.GetPath().string(), {}, clock, Core::Logger(sink, "trace"), queueBytes);
        REQUIRE(trace.has_value());
        (*trace)->Keep();
        return std::move(*trace);
    }
};

} // namespace

TEST_CASE_METHOD(TraceFixture, "A trace has a line per message with both times, link, direction, robot and topic")
{
    const Core::Now now = clock.GetNow();
    {
        const auto trace = Begin();
        trace->Write({"mcs", EWireDirection::Out, {}, {}, R"({"command":"Registration"})"});
        trace->Write({"mqtt", EWireDirection::In, "LR01", "uagv/v2/ACS/LR01/state", "{}"});
    }
    const std::vector<std::string> lines = ReadLines(folder.GetPath());
    REQUIRE(lines.size() == 2);
    CHECK(
        lines[0].find(R"("link":"mcs","direction":"out","text":"{\"command\":\"Registration\"}"})")
        != std::string::npos);
    CHECK(lines[0].starts_with("{\"time\":\""));
    CHECK(lines[1] == MakeTraceLine({"mqtt", EWireDirection::In, "LR01", "uagv/v2/ACS/LR01/state", "{}"}, now));
    const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(now.steady.time_since_epoch()).count();
    CHECK(lines[1].find("\"mono_us\":" + std::to_string(micros) + ",") != std::string::npos);
    CHECK(lines[1].find(R"("robot":"LR01","topic":"uagv/v2/ACS/LR01/state")") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "A start that fails leaves no file, one that succeeds deletes the oldest ones")
{
    const auto create = [this] {
        auto trace = MessageTrace::Create(folder.GetPath().string(), {100, 1}, clock, Core::Logger(sink, "trace"));
        REQUIRE(trace.has_value());
        return std::move(*trace);
    };
    create()->Keep();
    create()->Write({"mcs", EWireDirection::In, {}, {}, "lost"});
    CHECK(Testing::ListNames(folder.GetPath()) == std::vector<std::string>{"acsd-000001.ndjson"});
    create()->Keep();
    CHECK(Testing::ListNames(folder.GetPath()) == std::vector<std::string>{"acsd-000002.ndjson"});
}

TEST_CASE("Text that is not valid UTF-8 is kept byte for byte, escaped and marked")
{
    const std::string line = MakeTraceLine({"arm", EWireDirection::In, "CR01", {}, "\xFF{\\}\xC3\xA9\xC3"}, {});
    CHECK(line.find(R"("text":"\\xFF{\\\\}é\\xC3","escaped":true})") != std::string::npos);
    const std::string good = MakeTraceLine({"arm", EWireDirection::In, "CR01", {}, "{\\}\xC3\xA9\n"}, {});
    CHECK(good.find(R"("text":"{\\}é\n"})") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "Messages beyond the queue are lost, counted, and noted in the trace")
{
    {
        const auto trace = Begin(1'000);
        trace->Write({"mcs", EWireDirection::In, {}, {}, std::string(2'000, 'x')});
        trace->Write({"mcs", EWireDirection::In, {}, {}, std::string(2'000, 'x')});
        CHECK(trace->GetLost() == 2);
        trace->Write({"mcs", EWireDirection::In, {}, {}, "short"});
        trace->Write({"mcs", EWireDirection::In, {}, {}, std::string(2'000, 'x')});
        CHECK(trace->GetLost() == 3);
    }
    const std::vector<std::string> lines = ReadLines(folder.GetPath());
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].find(R"("link":"trace","lost":2})") != std::string::npos);
    CHECK(lines[1].find("short") != std::string::npos);
    CHECK(lines[2].find(R"("link":"trace","lost":1})") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "A full disk is logged once, and the trace continues when there is room again")
{
    {
        const auto trace = Begin();
        {
            const FullDisk full(0);
            trace->Write({"mcs", EWireDirection::In, {}, {}, "one"});
            while (trace->GetLost() < 1)
            {
                std::this_thread::yield(); // the thread writes when it writes
            }
            trace->Write({"mcs", EWireDirection::In, {}, {}, "two"});
            while (trace->GetLost() < 2)
            {
                std::this_thread::yield();
            }
        }
        CHECK(sink.CountLevel(Core::ELogLevel::Error) == 1);
        clock.Advance(std::chrono::seconds(11));
        trace->Write({"mcs", EWireDirection::In, {}, {}, "three"});
    }
    const std::vector<std::string> lines = ReadLines(folder.GetPath());
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].find(R"("lost":2})") != std::string::npos);
    CHECK(lines[1].find("three") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "The trace states at its end what a full disk has lost")
{
    {
        const auto trace = Begin();
        const FullDisk full(0);
        trace->Write({"mcs", EWireDirection::In, {}, {}, "one"});
        while (trace->GetLost() < 1)
        {
            std::this_thread::yield();
        }
        trace->Write({"mcs", EWireDirection::In, {}, {}, "two"});
        while (trace->GetLost() < 2)
        {
            std::this_thread::yield();
        }
    }
    const std::vector<std::string> lines = ReadLines(folder.GetPath());
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find(R"("lost":2})") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "A folder that cannot be made is an error with its name")
{
    std::ofstream(folder.GetPath() / "file") << "x";
    const auto trace =
        MessageTrace::Create((folder.GetPath() / "file" / "trace").string(), {}, clock, Core::Logger(sink, "trace"));
    REQUIRE_FALSE(trace.has_value());
    CHECK(Core::Describe(trace.error()).find("file/trace") != std::string::npos);
}

TEST_CASE_METHOD(TraceFixture, "An arm's bytes become lines, wherever they were cut, and a lost connection ends one")
{
    {
        const auto trace = Begin();
        ArmTrace arm(*trace, "CR01");
        arm.OnReceived("{\"a\":1}\r\n{\"b\"");
        arm.OnSent("{\"cmd\":1}\n{\"cmd\":2}\n");
        arm.OnReceived(":2}\n\n{\"c");
        arm.OnLost();
        arm.OnReceived("{\"d\":4}\n");
    }
    const std::vector<std::string> lines = ReadLines(folder.GetPath());
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].find(R"("link":"arm","direction":"in","robot":"CR01","text":"{\"a\":1}"})") != std::string::npos);
    CHECK(lines[1].find(R"("direction":"out","robot":"CR01","text":"{\"cmd\":1}"})") != std::string::npos);
    CHECK(lines[3].find(R"("text":"{\"b\":2}"})") != std::string::npos);
    CHECK(lines[4].find(R"("text":"{\"c"})") != std::string::npos);
    CHECK(lines[5].find(R"("text":"{\"d\":4}"})") != std::string::npos);
}

} // namespace ACS::Acsd::Test

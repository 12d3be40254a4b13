#include "wire/TraceFile.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <fstream>
#include <sstream>
#include <string>

using ACS::McsSim::MakeTraceLine;
using ACS::McsSim::TraceFile;
using ACS::ProtocolBeast::EWireDirection;
using namespace std::chrono_literals;

TEST_CASE("A line of the trace has times, direction, connection, what the message names, and the message as it was")
{
    const ACS::Core::Now now{ACS::Core::SteadyTime(5s), ACS::Core::WallTime(1'751'457'600'123ms)};
    CHECK(
        MakeTraceLine(
            now,
            EWireDirection::In,
            3,
            R"({"transactionId": "T1", "payload":{"planId":"P1","robotId":null}})")
        == R"({"time":"2025-07-02T12:00:00.123Z","mono_us":5000000,"program":"mcs-sim","link":"mcs","direction":"in","connection":3,"plan":"P1","transaction":"T1","text":"{\"transactionId\": \"T1\", \"payload\":{\"planId\":\"P1\",\"robotId\":null}}"})");
}

TEST_CASE("Text that is not JSON stays on one line of the trace")
{
    CHECK(MakeTraceLine({}, EWireDirection::Out, 1, "{\"a\" \n").ends_with(R"("text":"{\"a\" \n"})"));
}

TEST_CASE("A trace replaces an existing file, and a path that is not writable is reported")
{
    const ACS::Testing::TemporaryFolder folder;
    const ACS::Testing::ManualClock clock;
    const std::string path = (folder.GetPath() / "trace.ndjson").string();
    std::ofstream(path) << "older\n";
    const auto trace = TraceFile::Create(path, clock, ACS::Core::Logger());
    REQUIRE(trace.has_value());
    (*trace)->Write(EWireDirection::In, 1, "{}");
    (*trace)->Write(EWireDirection::Out, 1, "{}");
    CHECK((*trace)->TryClose());
    std::ostringstream content;
    content << std::ifstream(path).rdbuf();
    CHECK(content.str().find("older") == std::string::npos);
    CHECK(content.str().find("\"in\"") < content.str().find("\"out\""));

    const auto refused = TraceFile::Create(folder.GetPath().string(), clock, ACS::Core::Logger());
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().find("Is a directory") != std::string::npos);
}

TEST_CASE("A trace states that it is incomplete when its disk is full")
{
    const ACS::Testing::ManualClock clock;
    const auto trace = TraceFile::Create("/dev/full", clock, ACS::Core::Logger());
    REQUIRE(trace.has_value());
    (*trace)->Write(EWireDirection::In, 1, "{}");
    CHECK_FALSE((*trace)->TryClose());
}

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

namespace
{

constexpr ACS::Core::WallTime NOON{1'751'457'600'123ms};

} // namespace

TEST_CASE("A line of the trace has time, direction, connection and the message as it was")
{
    CHECK(
        MakeTraceLine(NOON, 9h, EWireDirection::In, 3, R"({"a": "\u002B", "a":1})")
        == R"({"time":"2025-07-02T21:00:00.123+09:00","direction":"in","connection":3,"message":{"a": "\u002B", "a":1}})");
}

TEST_CASE("Invalid JSON is a string in the trace, and a message with line ends stays on one line")
{
    const std::string head = R"({"time":"2025-07-02T12:00:00.123+00:00","direction":"out","connection":1,"message":)";
    CHECK(MakeTraceLine(NOON, 0min, EWireDirection::Out, 1, "{\"a\" \n") == head + R"("{\"a\" \n"})");
    CHECK(MakeTraceLine(NOON, 0min, EWireDirection::Out, 1, "{\r\n \"a\": [1,\n2]}") == head + R"({"a":[1,2]}})");
    CHECK(MakeTraceLine(NOON, 0min, EWireDirection::Out, 1, "\xEF\xBB\xBF{}") == head + "\"\xEF\xBB\xBF{}\"}");
}

TEST_CASE("A trace replaces an existing file, and a path that is not writable is reported")
{
    const ACS::Testing::TemporaryFolder folder;
    const ACS::Testing::ManualClock clock;
    const std::string path = (folder.GetPath() / "trace.ndjson").string();
    std::ofstream(path) << "older\n";
    const auto trace = TraceFile::Create(path, clock, 0min, ACS::Core::Logger());
    REQUIRE(trace.has_value());
    (*trace)->Write(EWireDirection::In, 1, "{}");
    (*trace)->Write(EWireDirection::Out, 1, "{}");
    CHECK((*trace)->TryClose());
    std::ostringstream content;
    content << std::ifstream(path).rdbuf();
    CHECK(content.str().find("older") == std::string::npos);
    CHECK(content.str().find("\"in\"") < content.str().find("\"out\""));

    const auto refused = TraceFile::Create(folder.GetPath().string(), clock, 0min, ACS::Core::Logger());
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().find("Is a directory") != std::string::npos);
}

TEST_CASE("A trace states that it is incomplete when its disk is full")
{
    const ACS::Testing::ManualClock clock;
    const auto trace = TraceFile::Create("/dev/full", clock, std::chrono::minutes(0), ACS::Core::Logger());
    REQUIRE(trace.has_value());
    (*trace)->Write(EWireDirection::In, 1, "{}");
    CHECK_FALSE((*trace)->TryClose());
}

#include "common/trace/SimulatorTrace.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "FullDisk.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ACS::Testing
{

namespace
{

struct SimulatorTraceFixture
{
    TemporaryFolder folder;
    ManualClock clock;
    RecordingLogSink sink;

    [[nodiscard]] tl::expected<std::unique_ptr<Apps::SimulatorTrace>, std::string> Open(
        const std::string& path,
        const Apps::TraceLimits& limits = {}) const
    {
        return Apps::SimulatorTrace::Create("vda-sim", {path, limits}, clock, Core::Logger());
    }

    [[nodiscard]] std::unique_ptr<Apps::SimulatorTrace> Begin(const Apps::TraceLimits& limits = {})
    {
        auto trace = Apps::SimulatorTrace::Create(
            "vda-sim",
            {folder.GetPath().string(), limits},
            clock,
            Core::Logger(sink, "vda-sim"));
        REQUIRE(trace.has_value());
        return std::move(*trace);
    }
};

Apps::TraceLine MakeMessage(std::string_view text)
{
    Apps::TraceLine line;
    line.link = "mqtt";
    line.text = text;
    return line;
}

} // namespace

TEST_CASE_METHOD(SimulatorTraceFixture, "A line of a simulator has the times first, then its name, and what it knows")
{
    {
        const auto trace = Begin();
        Apps::TraceLine line = MakeMessage(R"({"cmd":1})");
        line.link = "arm";
        line.bIn = true;
        line.robotID = "CR01";
        line.controller = 2;
        line.connection = 7;
        trace->Write(line);
        const Core::Now before = trace->GetNow();
        clock.Advance(std::chrono::milliseconds(5));
        trace->Write(MakeMessage("{}"), before);
    }
    CHECK(
        ReadLines(folder.GetPath())
        == std::vector<std::string>{
            R"({"time":"2025-07-02T12:00:00.000Z","mono_us":1000000000,"program":"vda-sim","link":"arm","direction":"in","controller":2,"connection":7,"robot":"CR01","text":"{\"cmd\":1}"})",
            R"({"time":"2025-07-02T12:00:00.000Z","mono_us":1000000000,"program":"vda-sim","link":"mqtt","direction":"out","text":"{}"})"});
    CHECK(ListNames(folder.GetPath()) == std::vector<std::string>{"vda-sim-000001.ndjson"});
    const auto permissions = std::filesystem::status(folder.GetPath() / "vda-sim-000001.ndjson").permissions();
    CHECK((permissions & std::filesystem::perms::group_read) == std::filesystem::perms::none);
    CHECK((permissions & std::filesystem::perms::others_read) == std::filesystem::perms::none);
}

TEST_CASE_METHOD(
    SimulatorTraceFixture,
    "A start of a simulator that ends without a message deletes no file and leaves none")
{
    const Apps::TraceLimits limits{4'096, 1};
    Begin(limits)->Write(MakeMessage("{}"));
    Begin(limits).reset(); // its port is taken
    CHECK(ListNames(folder.GetPath()) == std::vector<std::string>{"vda-sim-000001.ndjson"});
    CHECK(ReadLines(folder.GetPath()).size() == 1);
    Begin(limits)->Write(MakeMessage("{}"));
    CHECK(ListNames(folder.GetPath()).size() == 1);
    CHECK(ReadLines(folder.GetPath()).size() == 1);
}

TEST_CASE_METHOD(SimulatorTraceFixture, "The trace does not exceed its limits, however many messages there are")
{
    constexpr std::uint64_t FILE_BYTES = 4'096;
    constexpr std::size_t FILES = 3;
    {
        const auto trace = Begin({FILE_BYTES, FILES});
        for (int i = 0; i < 1'000; ++i)
        {
            trace->Write(MakeMessage(std::string(50, 'x')));
        }
    }
    const std::vector<std::string> names = ListNames(folder.GetPath());
    CHECK(names.size() == FILES);
    for (const std::string& name : names)
    {
        CHECK(std::filesystem::file_size(folder.GetPath() / name) <= FILE_BYTES);
    }
}

TEST_CASE_METHOD(SimulatorTraceFixture, "Lines that a full disk has lost are stated in the log at the end")
{
    {
        const FullDisk full(0);
        const auto trace = Begin();
        trace->Write(MakeMessage("{}"));
    }
    CHECK(sink.CountLevel(Core::ELogLevel::Warning) == 1);
    CHECK(sink.ContainsField("count", "1"));
}

TEST_CASE_METHOD(
    SimulatorTraceFixture,
    "A folder that cannot be used is refused with its name, the reason and what to do")
{
    const std::string file = (folder.GetPath() / "file").string();
    std::ofstream(file) << "x";
    for (const std::string& path : {file, file + "/trace", std::string("/proc/trace"), std::string("/dev/null")})
    {
        CAPTURE(path);
        const auto trace = Open(path);
        REQUIRE_FALSE(trace.has_value());
        CHECK(trace.error().starts_with("--trace: cannot write to the folder " + path + ": "));
        CHECK(trace.error().ends_with(
            "; give a folder in which this user may create files (it is created if necessary)"));
    }
    CHECK(Open((folder.GetPath() / "a" / "b").string()).has_value());
}

TEST_CASE("The options of a trace are its folder and its limits")
{
    const auto parse = [](std::vector<const char*> words, Apps::TraceOptions& options) {
        CLI::App app;
        Apps::AddTraceOptions(app, options);
        words.insert(words.begin(), "program");
        try
        {
            app.parse(static_cast<int>(words.size()), words.data());
            return std::string();
        }
        catch (const CLI::ParseError& error)
        {
            return std::string(error.what());
        }
    };
    Apps::TraceOptions options;
    CHECK(parse({}, options).empty());
    CHECK(options.folder.empty());
    CHECK(options.limits == Apps::TraceLimits{});
    CHECK(parse({"--trace", "d", "--trace-max-file-bytes", "4096", "--trace-max-files", "2"}, options).empty());
    CHECK(options.folder == "d");
    CHECK(options.limits == Apps::TraceLimits{4'096, 2});
    CHECK(parse({"--trace", ""}, options).find("expected a folder") != std::string::npos);
    CHECK(parse({"--trace", "d", "--trace-max-files", "0"}, options).find("from 1 to 10000") != std::string::npos);
    CHECK(parse({"--trace", "d", "--trace-max-file-bytes", "1k"}, options).find("found \"1k\"") != std::string::npos);
    CHECK(parse({"--trace-max-files", "2"}, options).find("--trace") != std::string::npos);
}

} // namespace ACS::Testing

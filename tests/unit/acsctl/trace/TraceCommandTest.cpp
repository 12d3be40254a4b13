#include "trace/TraceCommand.hpp"

#include "Catch.hpp"
#include "TemporaryFolder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Acsctl::Test
{

namespace
{

/// A line with the time 10:00:00 and the milliseconds, and the microseconds of the monotonic clock, which are also its text.
std::string MakeLine(int milliseconds, int micros, const std::string& members)
{
    return fmt::format(
        R"({{"time":"2026-11-28T10:00:00.{:03}Z","mono_us":{},{},"text":"{}"}})",
        milliseconds,
        micros,
        members,
        micros);
}

struct TraceFolderFixture
{
    Testing::TemporaryFolder folder;
    AcsctlOptions options;

    TraceFolderFixture()
    {
        options.command = ECommand::Trace;
        options.bJSON = true;
        options.arguments.files = {folder.GetPath().string()};
    }

    void Write(const std::string& name, const std::vector<std::string>& lines, const std::string& rest = {}) const
    {
        std::ofstream file(folder.GetPath() / name);
        for (const std::string& line : lines)
        {
            file << line << "\n";
        }
        file << rest;
    }

    [[nodiscard]] Outcome<std::string> Run() const
    {
        return RunTraceFiles(options, {});
    }

    /// The texts of the lines that are shown.
    [[nodiscard]] std::vector<std::string> ReadTexts() const
    {
        const Outcome<std::string> shown = Run();
        REQUIRE(shown.has_value());
        std::vector<std::string> texts;
        const std::string begin = R"("text":")";
        for (std::size_t at = shown->find(begin); at != std::string::npos; at = shown->find(begin, at + 1))
        {
            const std::size_t first = at + begin.size();
            texts.push_back(shown->substr(first, shown->find('"', first) - first));
        }
        return texts;
    }
};

using Texts = std::vector<std::string>;

constexpr const char* ACSD_OUT = R"("link":"mqtt","direction":"out","robot":"LR01","plan":"P1")";
constexpr const char* ACSD_IDLE = R"("link":"mqtt","direction":"in","robot":"LR01")";
constexpr const char* VDA_IN = R"("program":"vda-sim","link":"mqtt","direction":"in","robot":"LR01")";
constexpr const char* VDA_OTHER = R"("program":"vda-sim","link":"mqtt","direction":"in","robot":"LR02")";
constexpr const char* MCS_IN =
    R"("program":"mcs-sim","link":"mcs","direction":"in","plan":"P1","robot":"LR01","transaction":"T1")";

} // namespace

TEST_CASE_METHOD(
    TraceFolderFixture,
    "Traces are merged by their wall clocks, within a millisecond by the monotonic clock")
{
    Write("acsd-000002.ndjson", {MakeLine(5, 900, ACSD_OUT), MakeLine(7, 1'200, ACSD_OUT)});
    Write("acsd-000010.ndjson", {MakeLine(8, 1'300, ACSD_OUT)});
    Write("vda-sim-000001.ndjson", {MakeLine(5, 899, VDA_IN), MakeLine(5, 1'000, VDA_IN), MakeLine(6, 50, VDA_IN)});
    Write("trace.ndjson", {MakeLine(1, 2'000, MCS_IN), MakeLine(8, 1'299, MCS_IN)});
    Write("notes.txt", {"no trace"});
    CHECK(ReadTexts() == Texts{"2000", "899", "900", "1000", "50", "1200", "1299", "1300"});
    options.arguments.limit = 3;
    CHECK(ReadTexts() == Texts{"1200", "1299", "1300"});
}

TEST_CASE_METHOD(TraceFolderFixture, "Files and folders can be given, and a table shows which program wrote a line")
{
    Write("acsd-000001.ndjson", {MakeLine(5, 1, ACSD_OUT)});
    std::filesystem::create_directory(folder.GetPath() / "sub");
    Write("sub/vda-sim-000001.ndjson", {MakeLine(6, 2, VDA_IN)});
    options.arguments.files = {(folder.GetPath() / "acsd-000001.ndjson").string(), (folder.GetPath() / "sub").string()};
    options.bJSON = false;
    const Outcome<std::string> shown = RunTraceFiles(options, {{80, false}, {}});
    REQUIRE(shown.has_value());
    CHECK(
        *shown
        == "TIME          PROGRAM  LINK  DIR  ROBOT  WHAT\n"
           "10:00:00.005  acsd     mqtt  out  LR01   1\n"
           "10:00:00.006  vda-sim  mqtt  in   LR01   2\n");
}

TEST_CASE_METHOD(
    TraceFolderFixture,
    "A line of a simulator belongs to the plan that its robot has in the trace of acsd")
{
    Write(
        "acsd-000001.ndjson",
        {MakeLine(2, 2, ACSD_OUT),
         MakeLine(4, 4, R"("link":"core","direction":"in","kind":"timer","robot":"LR01","plan":"P1")"),
         MakeLine(5, 5, R"("link":"engine","direction":"out","kind":"note","robot":"LR01")"),
         MakeLine(7, 7, ACSD_IDLE)});
    Write(
        "vda-sim-000001.ndjson",
        {MakeLine(1, 1, VDA_IN),
         MakeLine(3, 3, VDA_IN),
         MakeLine(3, 33, VDA_OTHER),
         MakeLine(6, 6, VDA_IN),
         MakeLine(8, 8, VDA_IN)});
    Write("trace.ndjson", {MakeLine(9, 9, MCS_IN)});
    options.arguments.plan = "P1";
    CHECK(ReadTexts() == Texts{"2", "3", "6", "9"});
    options.arguments.plan = "P2";
    CHECK(ReadTexts().empty());
    options.arguments.plan.reset();
    options.arguments.robot = "LR02";
    CHECK(ReadTexts() == Texts{"33"});
    options.arguments.robot.reset();
    options.arguments.transaction = "T1";
    CHECK(ReadTexts() == Texts{"9"});
}

TEST_CASE_METHOD(TraceFolderFixture, "The incomplete last line of a program that was killed is omitted")
{
    Write("vda-sim-000001.ndjson", {MakeLine(1, 1, VDA_IN)}, R"({"time":"2026-11-28T10:00)");
    Write("vda-sim-000002.ndjson", {MakeLine(2, 2, VDA_IN)}, MakeLine(3, 3, VDA_IN));
    CHECK(ReadTexts() == Texts{"1", "2"});
}

TEST_CASE_METHOD(TraceFolderFixture, "What is not a trace is refused with its place")
{
    const auto check = [this](const std::string& expected) {
        const Outcome<std::string> shown = Run();
        REQUIRE_FALSE(shown.has_value());
        CHECK(shown.error().exitCode == EXIT_BAD_INPUT);
        CHECK(shown.error().text.find(expected) != std::string::npos);
    };
    check("has no trace (*.ndjson)");
    options.arguments.files = {(folder.GetPath() / "missing").string()};
    check("missing: No such file or directory");
    options.arguments.files = {folder.GetPath().string()};
    for (const char* line :
         {"", "odd", "{}", R"({"time":"2026","link":"mqtt"})", R"({"time":"2026","mono_us":x})", R"({"time":"2026)"})
    {
        CAPTURE(line);
        Write("acsd-000001.ndjson", {MakeLine(1, 1, ACSD_OUT), line});
        check("acsd-000001.ndjson:2 is not a line of a trace");
    }
    options.watch = std::chrono::milliseconds(100);
    check("--watch");
}

} // namespace ACS::Acsctl::Test

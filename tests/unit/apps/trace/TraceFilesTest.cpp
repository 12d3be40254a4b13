#include "common/trace/TraceFiles.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "FullDisk.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Testing
{

using Apps::TraceFiles;
using Apps::TraceLimits;

TEST_CASE("Files of a trace are limited in size and number; the oldest are deleted, other files are kept")
{
    const Testing::TemporaryFolder place;
    std::ofstream(place.GetPath() / "acsd-notes.ndjson") << "mine\n";
    const TraceLimits limits{100, 2};
    {
        TraceFiles files(place.GetPath().string());
        REQUIRE_FALSE(files.Open(limits));
        for (int i = 0; i < 9; ++i)
        {
            REQUIRE_FALSE(files.Append(std::to_string(i) + std::string(29, '-'), limits));
        }
        REQUIRE_FALSE(files.Flush());
        CHECK(
            ListNames(place.GetPath())
            == std::vector<std::string>{"acsd-000002.ndjson", "acsd-000003.ndjson", "acsd-notes.ndjson"});
        CHECK(std::filesystem::file_size(place.GetPath() / "acsd-000003.ndjson") == 93);
    }

    // A restart starts a new file, and a line that is longer than a file has a file of its own.
    TraceFiles next(place.GetPath().string());
    REQUIRE_FALSE(next.Open(limits));
    REQUIRE_FALSE(next.Append(std::string(200, 'x'), limits));
    REQUIRE_FALSE(next.Append("y", limits));
    REQUIRE_FALSE(next.Flush());
    CHECK(
        ListNames(place.GetPath())
        == std::vector<std::string>{"acsd-000004.ndjson", "acsd-000005.ndjson", "acsd-notes.ndjson"});
    CHECK(std::filesystem::file_size(place.GetPath() / "acsd-000004.ndjson") == 201);
}

TEST_CASE("A folder in which another writer has files of the same name is refused, one with other names is not")
{
    const Testing::TemporaryFolder place;
    const TraceLimits limits{20, 2};
    {
        TraceFiles files(place.GetPath().string());
        REQUIRE_FALSE(files.Open(limits));
        for (const char* line : {"one-one-one", "two-two-two", "three-three"})
        {
            const std::error_code refused = TraceFiles(place.GetPath().string()).Open(limits);
            CHECK(refused == std::errc::device_or_resource_busy);
            CHECK(Apps::DescribeTraceError(refused).find("another process") != std::string::npos);
            REQUIRE_FALSE(files.Append(line, limits));
            REQUIRE_FALSE(files.Flush());
        }
        CHECK(ListNames(place.GetPath()) == std::vector<std::string>{"acsd-000002.ndjson", "acsd-000003.ndjson"});
        CHECK_FALSE(TraceFiles(place.GetPath().string(), {"vda-sim-"}).Open(limits));
    }
    CHECK_FALSE(TraceFiles(place.GetPath().string()).Open(limits));
}

TEST_CASE("A full disk loses complete lines, which are counted, and leaves no partial line")
{
    const Testing::TemporaryFolder place;
    TraceFiles files(place.GetPath().string());
    REQUIRE_FALSE(files.Open({}));
    REQUIRE_FALSE(files.Append("first", {}));
    REQUIRE_FALSE(files.Flush());
    {
        const FullDisk full(10);
        REQUIRE_FALSE(files.Append("second", {}));
        REQUIRE_FALSE(files.Append("third", {}));
        CHECK(files.Flush());
        CHECK(files.GetLostLines() == 2);
    }
    REQUIRE_FALSE(files.Append("fourth", {}));
    REQUIRE_FALSE(files.Flush());
    CHECK(ReadLines(place.GetPath()) == std::vector<std::string>{"first", "fourth"});
}

TEST_CASE("A trace of one file replaces the file at the start and continues it after a failure")
{
    const Testing::TemporaryFolder place;
    const std::string path = (place.GetPath() / "trace.ndjson").string();
    std::ofstream(path) << "older\n";
    const TraceLimits limits{1'000, 0};
    TraceFiles files(path);
    REQUIRE_FALSE(files.Open(limits));
    REQUIRE_FALSE(files.Append("first", limits));
    REQUIRE_FALSE(files.Flush());
    {
        const FullDisk full(10);
        REQUIRE_FALSE(files.Append("second", limits));
        CHECK(files.Flush());
    }
    REQUIRE_FALSE(files.Append("third", limits));
    REQUIRE_FALSE(files.Flush());
    CHECK(ReadLines(place.GetPath()) == std::vector<std::string>{"first", "third"});
    CHECK(TraceFiles(place.GetPath().string()).Open(limits) == std::errc::is_a_directory);
}

TEST_CASE("The newest file is continued at a start if that is wanted, and the newest lines of all files can be read")
{
    const Testing::TemporaryFolder place;
    const Apps::TraceLimits limits{20, 3};
    const Apps::TraceFileStyle style{"audit-", 0600, true};
    for (const char* line : {"one", "two", "three", "four", "five", "six"})
    {
        TraceFiles files(place.GetPath().string(), style);
        REQUIRE_FALSE(files.Open(limits));
        REQUIRE_FALSE(files.Append(line, limits));
        REQUIRE_FALSE(files.Flush());
    }
    const std::string folder = place.GetPath().string();
    CHECK(Apps::ReadNewestLines(folder, "audit-", 2) == std::vector<std::string>{"five", "six"});
    CHECK(
        Apps::ReadNewestLines(folder, "audit-", 9)
        == std::vector<std::string>{"one", "two", "three", "four", "five", "six"});
    CHECK(Apps::ReadNewestLines(folder, "acsd-", 9).empty());
    CHECK(std::filesystem::file_size(place.GetPath() / "audit-000001.ndjson") == 19);
    CHECK(std::filesystem::file_size(place.GetPath() / "audit-000002.ndjson") == 9);
}

} // namespace ACS::Testing

#include "common/trace/TraceFiles.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "FullDisk.hpp"
#include "TemporaryFolder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
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

TEST_CASE("A full disk deletes no file and makes no empty one, however long it lasts")
{
    const Testing::TemporaryFolder place;
    const TraceLimits limits{25, 3};
    const bool bContinued = GENERATE(false, true);
    TraceFiles files(place.GetPath().string(), {"acsd-", 0600, bContinued});
    REQUIRE_FALSE(files.Open(limits));
    for (const char* line : {"one-one-one", "two-two-two", "three-three", "four-four-f", "five-five-f"})
    {
        REQUIRE_FALSE(files.Append(line, limits));
    }
    REQUIRE_FALSE(files.Flush());
    const std::vector<std::string> names = ListNames(place.GetPath());
    REQUIRE(names == std::vector<std::string>{"acsd-000001.ndjson", "acsd-000002.ndjson", "acsd-000003.ndjson"});
    {
        const FullDisk full(14);
        for (int i = 0; i < 20; ++i)
        {
            REQUIRE_FALSE(files.Append("lost", limits));
            CHECK(files.Flush());
            CHECK(files.GetLostLines() == 1);
        }
    }
    CHECK(ListNames(place.GetPath()) == names);

    // The file that is continued is not longer than the limit.
    REQUIRE_FALSE(files.Append("six-six-six-six", limits));
    REQUIRE_FALSE(files.Flush());
    CHECK(
        ListNames(place.GetPath())
        == std::vector<std::string>{"acsd-000002.ndjson", "acsd-000003.ndjson", "acsd-000004.ndjson"});
    CHECK(
        ReadLines(place.GetPath())
        == std::vector<std::string>{"three-three", "four-four-f", "five-five-f", "six-six-six-six"});
}

TEST_CASE("Starts that fail delete no file and leave none, and those that crash have a limit, too")
{
    const Testing::TemporaryFolder place;
    const std::string folder = place.GetPath().string();
    const TraceLimits limits{20, 3};
    enum class EEnd
    {
        Ends,
        Fails,
        Crashes
    };
    const auto run = [&](EEnd end, int lines = 1) {
        TraceFiles files(folder, {"acsd-", 0600, false, true});
        REQUIRE_FALSE(files.Open(limits));
        for (int i = 0; i < lines; ++i)
        {
            REQUIRE_FALSE(files.Append("fifteen letters", limits));
        }
        REQUIRE_FALSE(files.Flush());
        if (end == EEnd::Ends)
        {
            Apps::DeleteOldestFiles(folder, "acsd-", limits.maxFiles);
        }
        else if (end == EEnd::Fails)
        {
            files.Discard();
        }
    };
    for (int i = 0; i < 4; ++i)
    {
        run(EEnd::Ends);
    }
    const std::vector<std::string> names{"acsd-000002.ndjson", "acsd-000003.ndjson", "acsd-000004.ndjson"};
    CHECK(ListNames(place.GetPath()) == names);
    for (int i = 0; i < 10; ++i)
    {
        run(EEnd::Fails);
    }
    CHECK(ListNames(place.GetPath()) == names);
    for (int i = 0; i < 10; ++i)
    {
        run(EEnd::Crashes);
    }
    CHECK(ListNames(place.GetPath()).size() == 2 * limits.maxFiles);
    run(EEnd::Ends);
    CHECK(ListNames(place.GetPath()).size() == limits.maxFiles);
    // A start that has written more than one file keeps them.
    run(EEnd::Fails, 2);
    CHECK(ListNames(place.GetPath()).back() == "acsd-000017.ndjson");
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

TEST_CASE("Only regular files are read, continued and deleted; the others keep their names")
{
    const Testing::TemporaryFolder place;
    const auto& folder = place.GetPath();
    const TraceLimits limits{100, 2};
    std::ofstream(folder / "elsewhere") << "secret\n";
    const bool bContinued = GENERATE(false, true);
    {
        TraceFiles files(folder.string(), {"acsd-", 0600, bContinued});
        REQUIRE_FALSE(files.Open(limits));
        REQUIRE_FALSE(files.Append("one", limits));
        REQUIRE_FALSE(files.Flush());
    }
    REQUIRE(::mkfifo((folder / "acsd-000002.ndjson").c_str(), 0600) == 0);
    std::filesystem::create_directory(folder / "acsd-000003.ndjson");
    std::filesystem::create_symlink("/dev/zero", folder / "acsd-000004.ndjson");
    std::filesystem::create_symlink(folder / "elsewhere", folder / "acsd-000005.ndjson");
    CHECK(Apps::ReadNewestLines(folder.string(), "acsd-", 9) == std::vector<std::string>{"one"});
    for (int i = 0; i < 3; ++i)
    {
        TraceFiles files(folder.string(), {"acsd-", 0600, bContinued});
        REQUIRE_FALSE(files.Open(limits));
        REQUIRE_FALSE(files.Append(std::string(90, 'x'), limits));
        REQUIRE_FALSE(files.Flush());
    }
    CHECK(Apps::ReadNewestLines(folder.string(), "acsd-", 9) == std::vector<std::string>(2, std::string(90, 'x')));
    const std::vector<std::string> others{
        "acsd-000002.ndjson",
        "acsd-000003.ndjson",
        "acsd-000004.ndjson",
        "acsd-000005.ndjson"};
    const std::vector<std::string> names = ListNames(folder);
    CHECK(std::ranges::includes(names, others));
    CHECK(names.size() == others.size() + 3); // two files and the target of the link
    CHECK(std::filesystem::file_size(folder / "elsewhere") == 7);
}

TEST_CASE("A file whose name has no usable number is left alone")
{
    const Testing::TemporaryFolder place;
    const auto& folder = place.GetPath();
    for (const char* name :
         {"acsd-18446744073709551615.ndjson", "acsd-99999999999999999999999.ndjson", "acsd--1.ndjson"})
    {
        std::ofstream(folder / name) << "line\n";
    }
    for (const char* expected : {"acsd-000001.ndjson", "acsd-000002.ndjson"})
    {
        TraceFiles files(folder.string());
        REQUIRE_FALSE(files.Open({}));
        CHECK(std::filesystem::exists(folder / expected));
    }
    CHECK(Apps::ReadNewestLines(folder.string(), "acsd-", 9).empty());
    std::ofstream(folder / "acsd-999999999999.ndjson") << "line\n";
    const std::error_code full = TraceFiles(folder.string()).Open({});
    CHECK(full == std::errc::value_too_large);
    CHECK(Apps::DescribeTraceError(full).find("newest file") != std::string::npos);
}

TEST_CASE("Of a long file the whole lines at its end are read, however long its lines are")
{
    const Testing::TemporaryFolder place;
    const auto file = place.GetPath() / "acsd-000001.ndjson";
    std::ofstream(file) << std::string(6'000'000, 'x') << "\nlast\ncut";
    CHECK(Apps::ReadNewestLines(place.GetPath().string(), "acsd-", 9) == std::vector<std::string>{"last"});
    std::ofstream(file) << std::string(6'000'000, 'x');
    CHECK(Apps::ReadNewestLines(place.GetPath().string(), "acsd-", 9).empty());
}

} // namespace ACS::Testing

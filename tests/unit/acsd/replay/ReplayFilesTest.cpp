#include "replay/ReplayFiles.hpp"

#include "Catch.hpp"
#include "replay/RecordKind.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

const std::string BEGIN =
    R"({"time":"2026-01-01T00:00:00.000Z","mono_us":1,"link":"core","direction":"out","kind":"begin","text":"{}"})";
const std::string SPACED =
    R"({ "time" : "2026-01-01T00:00:00.000Z", "mono_us": 2, "link": "core", "direction": "in", "kind": "start", "text": "{}" })";
const std::string MESSAGE =
    R"({"time":"2026-01-01T00:00:00.000Z","mono_us":3,"link":"mqtt","direction":"in","robot":"LR01","topic":"t","text":"{"})";
const std::string SPACED_MESSAGE =
    R"({"time": "2026-01-01T00:00:00.000Z", "mono_us": 3, "link": "mqtt", "direction": "in", "topic": "t", "text": "{"})";

struct ReplayFolder
{
    Testing::TemporaryFolder folder;
    std::string file = (folder.GetPath() / "acsd-000001.ndjson").string();

    void Write(const std::vector<std::string>& lines) const
    {
        std::ofstream out(file);
        for (const std::string& line : lines)
        {
            out << line << '\n';
        }
    }

    [[nodiscard]] static std::string DescribeRefusal(const std::string& path)
    {
        const Core::Result<ReplayFiles> files = ReplayFiles::Open(path);
        return files.has_value() ? std::string() : Core::Describe(files.error());
    }
};

} // namespace

TEST_CASE_METHOD(ReplayFolder, "Records are read however they are spaced, and messages are skipped")
{
    Write({BEGIN, MESSAGE, SPACED_MESSAGE, SPACED, MESSAGE});
    Core::Result<ReplayFiles> files = ReplayFiles::Open(file);
    REQUIRE(files.has_value());
    REQUIRE(files->FindRunOrNull().has_value());
    const std::optional<CoreRecord> record = files->ReadNextOrNull();
    REQUIRE(record.has_value());
    CHECK(record->kind == "start");
    CHECK(record->place == "acsd-000001.ndjson:4");
    CHECK_FALSE(files->ReadNextOrNull().has_value());
    CHECK(files->GetFault().empty());
    CHECK(files->DescribeForeign().empty());
}

TEST_CASE_METHOD(ReplayFolder, "A line that is not one of a trace is a fault with its place")
{
    for (const std::string& line :
         {std::string("hello"),
          std::string(),
          std::string("{}"),
          std::string("[]"),
          MESSAGE.substr(0, MESSAGE.size() - 5),
          std::string(R"({"time":"2026-01-01T00:00:00.000Z","mono_us":"1","link" :"core"})"),
          std::string(R"({"time":"never","mono_us":1,"link" :"core","kind":"start"})")})
    {
        CAPTURE(line);
        Write({BEGIN, MESSAGE, line, SPACED});
        Core::Result<ReplayFiles> files = ReplayFiles::Open(file);
        REQUIRE(files.has_value());
        REQUIRE(files->FindRunOrNull().has_value());
        CHECK_FALSE(files->ReadNextOrNull().has_value());
        CHECK(files->GetFault().starts_with("acsd-000001.ndjson:3: "));
    }
}

TEST_CASE_METHOD(ReplayFolder, "A file that is not a trace is described as such, with its first line")
{
    for (const std::vector<std::string>& lines :
         {std::vector<std::string>{"hello", "world"}, std::vector<std::string>{}, std::vector<std::string>{"{}"}})
    {
        Write(lines);
        Core::Result<ReplayFiles> files = ReplayFiles::Open(folder.GetPath().string());
        REQUIRE(files.has_value());
        CHECK_FALSE(files->FindRunOrNull().has_value());
        const std::string reason = files->DescribeForeign();
        CHECK(reason.starts_with("not a trace of acsd: "));
        CHECK((reason.find("acsd-000001.ndjson:1: ") != std::string::npos) == !lines.empty());
    }
    Write({MESSAGE});
    Core::Result<ReplayFiles> files = ReplayFiles::Open(file);
    REQUIRE(files.has_value());
    CHECK_FALSE(files->FindRunOrNull().has_value());
    CHECK(files->DescribeForeign().empty());
}

TEST_CASE_METHOD(ReplayFolder, "Only regular files are read")
{
    const std::string pipe = (folder.GetPath() / "acsd-000002.ndjson").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    std::filesystem::create_directory(folder.GetPath() / "acsd-000003.ndjson");
    std::filesystem::create_symlink("/dev/zero", folder.GetPath() / "acsd-000004.ndjson");
    CHECK(DescribeRefusal(folder.GetPath().string()).find("a file of a trace") != std::string::npos);
    for (const std::string& path : {pipe, std::string("/dev/zero"), (folder.GetPath() / "acsd-000004.ndjson").string()})
    {
        CHECK(DescribeRefusal(path).find("a regular file or a folder") != std::string::npos);
    }
    Write({BEGIN});
    Core::Result<ReplayFiles> files = ReplayFiles::Open(folder.GetPath().string());
    REQUIRE(files.has_value());
    CHECK(files->FindRunOrNull().has_value());
    CHECK_FALSE(files->FindRunOrNull().has_value());
}

TEST_CASE_METHOD(ReplayFolder, "A line beyond the limit is a fault, and the rest of its file is not read")
{
    Write({BEGIN, std::string(200'000, 'x'), BEGIN});
    Core::Result<ReplayFiles> files = ReplayFiles::Open(file, 100'000);
    REQUIRE(files.has_value());
    REQUIRE(files->FindRunOrNull().has_value());
    CHECK_FALSE(files->ReadNextOrNull().has_value());
    CHECK(files->GetFault() == "acsd-000001.ndjson:2: the line is longer than 100000 bytes");
    CHECK_FALSE(files->FindRunOrNull().has_value());

    // At the edges of the pieces in which a line is read.
    for (const std::size_t length : {65'534U, 65'535U, 65'536U, 65'537U, 131'070U, 131'071U})
    {
        const std::string text(length - BEGIN.size(), ' ');
        Write({BEGIN + text, SPACED});
        Core::Result<ReplayFiles> padded = ReplayFiles::Open(file);
        REQUIRE(padded.has_value());
        REQUIRE(padded->FindRunOrNull().has_value());
        const std::optional<CoreRecord> record = padded->ReadNextOrNull();
        REQUIRE(record.has_value());
        CHECK(record->place == "acsd-000001.ndjson:2");
    }
}

} // namespace ACS::Acsd::Test

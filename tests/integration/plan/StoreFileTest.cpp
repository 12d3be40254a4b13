#include "Catch.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;

/// Of the schema.
constexpr int NEWEST = 3;

class StoreFolder : public Testing::TemporaryFolder
{
public:
    [[nodiscard]] std::string GetFile(const std::string& name = "acsd.db") const
    {
        return (GetPath() / name).string();
    }

    [[nodiscard]] std::vector<std::string> ListNames() const
    {
        std::vector<std::string> names;
        for (const Files::directory_entry& entry : Files::directory_iterator(GetPath()))
        {
            names.push_back(entry.path().filename().string());
        }
        std::ranges::sort(names);
        return names;
    }
};

std::unique_ptr<SqlitePlanStore> OpenStore(const std::string& file)
{
    Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(file);
    INFO((store.has_value() ? std::string() : Core::Describe(store.error())));
    REQUIRE(store.has_value());
    return std::move(*store);
}

StoreBatch MakeBatch(const std::string& robotID)
{
    return {{MaintenanceChanged{robotID, true}}};
}

std::vector<std::string> LoadRobots(SqlitePlanStore& store)
{
    return store.Load()->robotsInMaintenance;
}

std::string DescribeFailure(const Core::Result<void>& result)
{
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().code == EPlanningError::StoreFailed);
    return Core::Describe(result.error());
}

template <typename T>
std::string DescribeOpening(const Core::Result<T>& result)
{
    REQUIRE_FALSE(result.has_value());
    return Core::Describe(result.error());
}

bool Contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

std::string ReadBytes(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What a program leaves that is killed while it has the store open.
void CopyAsKilled(const std::string& file, const std::string& copy)
{
    for (const char* ending : {"", "-wal", ".lock"})
    {
        Files::copy_file(file + ending, copy + ending);
    }
}

constexpr int FOLDING_WRITES = 1'200; ///< After so many the log has been folded.

void WriteMuch(SqlitePlanStore& store)
{
    for (int count = 0; count < FOLDING_WRITES; ++count)
    {
        REQUIRE(store.Append({{MaintenanceChanged{"LR01", count % 2 != 0}}}).has_value());
    }
}

void RequireLost(const std::string& file)
{
    const auto refused = SqlitePlanStore::Open(file);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreCorrupt);
    CHECK(Contains(Core::Describe(refused.error()), file + "-wal, as the program before did not close the store"));
    CHECK(Contains(Core::Describe(refused.error()), "a backup that was restored, remove " + file + ".lock"));
    CHECK_FALSE(SqlitePlanStore::Inspect(file).has_value());
}

/// While it lives the system takes no file that is longer.
class TightDisk
{
    rlimit _before{};
    void (*_handler)(int) = std::signal(SIGXFSZ, SIG_IGN);

public:
    explicit TightDisk(std::uintmax_t room)
    {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &_before) == 0);
        const rlimit tight{room, _before.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &tight) == 0);
    }

    TightDisk(const TightDisk&) = delete;
    TightDisk& operator=(const TightDisk&) = delete;

    ~TightDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &_before);
        std::signal(SIGXFSZ, _handler);
    }
};

} // namespace

TEST_CASE(
    "Store: a file that is removed while it is open is noticed without a write, saved, and made again by the next start")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        CHECK(store->Check().has_value());
        Files::remove(file);
        CHECK(
            DescribeFailure(store->Check())
            == file + ": expected the file that it has opened; put it back, or restart: what was stored is in " + file
                + ".rescued, and the next start takes it up, found " + file
                + " removed or moved away while it was open");
        CHECK(DescribeFailure(store->Append(MakeBatch("LR02"))) == DescribeFailure(store->Check()));
        CHECK_FALSE(Files::exists(file));
        CHECK_FALSE(SqlitePlanStore::Open(file).has_value()); // as long as this one has it
        // A crash leaves the log behind, which belongs to no other file.
        Files::copy_file(file + "-wal", folder.GetFile("log"));
    }
    Files::rename(folder.GetFile("log"), file + "-wal");
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
    CHECK(store->GetOrigin() == StoreOrigin{false, true, NEWEST, NEWEST});
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01"});
    CHECK(store->Append(MakeBatch("LR02")).has_value());
    CHECK_FALSE(Files::exists(file + ".rescued"));
}

TEST_CASE("Store: a log without its store is not thrown away for a new one")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string lost = folder.GetFile("lost.db");
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    Files::copy_file(file + "-wal", lost + "-wal"); // as a crash leaves it
    if (GENERATE(false, true))
    {
        std::ofstream(lost).flush();
    }
    for (const Core::Error& error : {SqlitePlanStore::Open(lost).error(), SqlitePlanStore::Inspect(lost).error()})
    {
        CHECK(error.code == EPlanningError::StoreCorrupt);
        CHECK(Contains(Core::Describe(error), lost + "-wal belongs; put that file back"));
    }
    CHECK(Files::file_size(lost + "-wal") == Files::file_size(file + "-wal"));
    Files::copy_file(file, lost, Files::copy_options::overwrite_existing);
    CHECK(LoadRobots(*OpenStore(lost)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a file that is put back is gone on with, and what was saved meanwhile goes")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::rename(file, folder.GetFile("away"));
        CHECK_FALSE(store->Append(MakeBatch("LR02")).has_value());
        CHECK(Files::exists(file + ".rescued"));
        Files::rename(folder.GetFile("away"), file);
        CHECK(store->Append(MakeBatch("LR02")).has_value());
        CHECK(store->Check().has_value());
    }
    CHECK(LoadRobots(*OpenStore(file)) == std::vector<std::string>{"LR01", "LR02"});
    CHECK(folder.ListNames() == std::vector<std::string>{"acsd.db", "acsd.db.lock"});
}

TEST_CASE(
    "Store: another file in the place of the open one is never written, and the next start asks which of the two holds")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string other = folder.GetFile("other.db");
    REQUIRE(OpenStore(other)->Append(MakeBatch("CR01")).has_value());
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::rename(other, file);
        const std::string failure = DescribeFailure(store->Append(MakeBatch("LR02")));
        CHECK(Contains(failure, "found another file in the place of " + file));
        CHECK(Contains(failure, "put it back, or move the other one away and restart"));
    }
    const std::string refusal = DescribeOpening(SqlitePlanStore::Open(file));
    CHECK(refusal.starts_with(file + ": expected one store; "));
    CHECK(Contains(refusal, file + ".rescued"));
    CHECK(DescribeOpening(SqlitePlanStore::Inspect(file)) == refusal);
    Files::rename(file, other);
    CHECK(LoadRobots(*OpenStore(file)) == std::vector<std::string>{"LR01"});
    CHECK(LoadRobots(*OpenStore(other)) == std::vector<std::string>{"CR01"});
}

TEST_CASE("Store: a write-ahead log that is removed is noticed, and what was in it is brought into the store")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::remove(file + "-wal");
        const std::string failure = DescribeFailure(store->Check());
        CHECK(Contains(failure, "found " + file + "-wal removed or moved away"));
        CHECK(Contains(failure, "restart: what was stored is in the store itself"));
        CHECK_FALSE(store->Append(MakeBatch("LR02")).has_value());
        Files::copy_file(file, folder.GetFile("crashed.db")); // as a crash would leave it
    }
    CHECK(LoadRobots(*OpenStore(folder.GetFile("crashed.db"))) == std::vector<std::string>{"LR01"});
    CHECK(LoadRobots(*OpenStore(file)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: where no copy can be made the failure says that all is lost with the program, and tries again")
{
    const StoreFolder folder;
    Files::create_directory(folder.GetFile("deep"));
    const std::string file = folder.GetFile("deep/acsd.db");
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::remove_all(folder.GetFile("deep"));
        CHECK(Contains(DescribeFailure(store->Check()), "or all is lost with it, as no copy can be made: " + file));
        Files::create_directory(folder.GetFile("deep"));
        CHECK(Contains(DescribeFailure(store->Check()), "the next start takes it up"));
    }
    CHECK(LoadRobots(*OpenStore(file)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: by a link the file is watched that the link leads to, with its log")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string link = folder.GetFile("link.db");
    Files::create_symlink(file, link);
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(link);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CHECK(store->Check().has_value());
    Files::remove(file + "-wal");
    CHECK(Contains(DescribeFailure(store->Check()), file + "-wal removed"));
}

TEST_CASE("Store: to look at one by a link reads the log of what the link leads to")
{
    const StoreFolder folder;
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
    SQLite::Database(folder.GetFile(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99"); // into the log
    Files::create_symlink(folder.GetFile(), folder.GetFile("link.db"));
    const Core::Result<StoreOrigin> seen = SqlitePlanStore::Inspect(folder.GetFile("link.db"));
    REQUIRE_FALSE(seen.has_value());
    CHECK(seen.error().code == EPlanningError::StoreTooNew);
}

TEST_CASE("Store: each failure to open names the path, the reason and what to do")
{
    struct Row
    {
        std::string file;
        std::string expected;
        std::string found;
    };
    const StoreFolder folder;
    std::ofstream(folder.GetFile("text")) << "not a database, and long enough to be told from an empty file";
    SQLite::Database(folder.GetFile("foreign"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec("CREATE TABLE t (a)");
    OpenStore(folder.GetFile("new")).reset();
    SQLite::Database(folder.GetFile("new"), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
    Files::create_directory(folder.GetFile("folder"));
    REQUIRE(::mkfifo(folder.GetFile("pipe").c_str(), 0600) == 0);
    Files::create_directory(folder.GetFile("locked"));
    Files::permissions(folder.GetFile("locked"), Files::perms::owner_read | Files::perms::owner_exec);
    OpenStore(folder.GetFile("read-only")).reset();
    Files::permissions(folder.GetFile("read-only"), Files::perms::owner_read);
    std::vector<Row> rows{
        {"none/acsd.db", "make the folder " + folder.GetFile("none"), "No such file or directory"},
        {"text/acsd.db", "a file in a folder; give another path", "which is no folder"},
        {"folder", "a file; give the path of one in that folder", "a folder"},
        {"pipe", "a regular file; give another path", "a device, a pipe or a socket"},
        {"text", "an undamaged plan store; move it away", "file is not a database"},
        {"foreign", "a plan store; give another path", "a database of another program"},
        {"new", "start the newer program that wrote it", "version 99"}};
    if (::geteuid() != 0) // who may do everything
    {
        rows.push_back({"locked/acsd.db", "correct the owner or the rights of", "Permission denied"});
        rows.push_back({"read-only", "correct its owner or its rights", "Permission denied"});
    }
    const std::vector<std::string> before = folder.ListNames();
    for (const Row& row : rows)
    {
        INFO(row.file);
        const std::string file = folder.GetFile(row.file);
        const std::string failure = DescribeOpening(SqlitePlanStore::Inspect(file));
        CHECK(failure.starts_with(file + ": expected "));
        CHECK(Contains(failure.substr(0, failure.find(", found ")), row.expected));
        CHECK(Contains(failure.substr(failure.find(", found ")), row.found));
        CHECK(DescribeOpening(SqlitePlanStore::Open(file)) == failure);
    }
    CHECK(folder.ListNames() == before);
    Files::permissions(folder.GetFile("locked"), Files::perms::owner_all);
}

TEST_CASE(
    "Store: a write that fails names the path, the reason and what to do, and is got over: another program's lock")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
    {
        SQLite::Database other(file, SQLite::OPEN_READWRITE);
        const SQLite::Transaction locks(other, SQLite::TransactionBehavior::IMMEDIATE);
        const std::string failure = DescribeFailure(store->Append(MakeBatch("LR01")));
        CHECK(failure.starts_with(file + ": expected a store that no other program locks; close that one"));
        CHECK(Contains(failure, "found writing failed: database is locked"));
    }
    CHECK(store->Append(MakeBatch("LR01")).has_value());
}

TEST_CASE(
    "Store: a write that fails names the path, the reason and what to do, and is got over: the system takes no more")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    const auto failed = [&store, &file] {
        const TightDisk disk(Files::file_size(file + "-wal"));
        return store->Append(MakeBatch("LR02"));
    }();
    const std::string failure = DescribeFailure(failed);
    CHECK(failure.starts_with(file + ": expected a disk that reads and writes; look at it and at the system's log"));
    INFO(failure);
    CHECK(Contains(failure, "found writing failed: disk I/O error (File too large)"));
    CHECK(store->Append(MakeBatch("LR02")).has_value());
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01", "LR02"});
}

TEST_CASE("Store: one that could not be made for want of room is made when there is some")
{
    for (const std::uintmax_t room : {0U, 1U, 4U, 5U, 8U, 16U, 24U, 32U, 40U, 64U})
    {
        INFO(room << " KiB");
        const StoreFolder folder;
        const std::string file = folder.GetFile();
        bool bMade = false;
        {
            const TightDisk disk(room * 1024);
            bMade = SqlitePlanStore::Open(file).has_value();
        }
        CHECK((room > 32 || !bMade));
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        CHECK(store->Append(MakeBatch("LR01")).has_value());
    }
}

TEST_CASE("Store: one that was not closed and whose log is missing is not opened, as what was stored last is missing")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string copy = folder.GetFile("copy.db");
    const auto store = OpenStore(file);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    // As a program leaves it that is killed.
    Files::copy_file(file, copy);
    Files::copy_file(file + ".lock", copy + ".lock");
    SECTION("The log is missing")
    {
        const auto refused = SqlitePlanStore::Open(copy);
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreCorrupt);
        CHECK(Core::Describe(refused.error()).find(copy + "-wal") != std::string::npos);
        CHECK_FALSE(SqlitePlanStore::Inspect(copy).has_value());
        Files::remove(copy + ".lock");
        CHECK_FALSE(OpenStore(copy)->GetOrigin().bNew);
    }
    SECTION("It is there")
    {
        Files::copy_file(file + "-wal", copy + "-wal");
        CHECK(OpenStore(copy)->Load()->robotsInMaintenance == std::vector<std::string>{"LR01"});
    }
}

TEST_CASE("Store: one that was not closed and whose log another program has folded is opened, as nothing is missing")
{
    const StoreFolder folder;
    const std::string copy = folder.GetFile("copy.db");
    const auto store = OpenStore(folder.GetFile());
    SECTION("A young one")
    {
    }
    SECTION("One that has folded its log before")
    {
        WriteMuch(*store);
    }
    REQUIRE(store->Append(MakeBatch("LR02")).has_value());
    CopyAsKilled(folder.GetFile(), copy);
    SQLite::Database(copy, SQLite::OPEN_READWRITE).exec("VACUUM INTO '" + folder.GetFile("backup.db") + "'");
    REQUIRE_FALSE(Files::exists(copy + "-wal"));
    CHECK(SqlitePlanStore::Inspect(copy).has_value());
    CHECK(LoadRobots(*OpenStore(copy)).back() == "LR02");
}

TEST_CASE("Store: what a lost log had is missed also where some of what was stored is in the file")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string copy = folder.GetFile("copy.db");
    const auto store = OpenStore(file);
    REQUIRE(store->Append(MakeBatch("CR01")).has_value());
    SECTION("It was folded by acsd itself")
    {
        WriteMuch(*store);
        CHECK(SqlitePlanStore::Inspect(file).has_value());
        CHECK(Files::file_size(file + "-wal") < 8'000'000);
    }
    SECTION("Another program tried to")
    {
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec("PRAGMA wal_checkpoint(TRUNCATE)");
    }
    SECTION("Another program read while acsd did")
    {
        SQLite::Database reader(file, SQLite::OPEN_READONLY);
        reader.exec("BEGIN; SELECT * FROM plans");
        WriteMuch(*store);
        REQUIRE(store->Append(MakeBatch("LR02")).has_value());
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec("PRAGMA wal_checkpoint(TRUNCATE)");
    }
    REQUIRE(store->Append(MakeBatch("LR03")).has_value());
    CopyAsKilled(file, copy);
    SECTION("The log is gone")
    {
        Files::remove(copy + "-wal");
        RequireLost(copy);
    }
    SECTION("The log is empty")
    {
        Files::resize_file(copy + "-wal", 0);
        RequireLost(copy);
    }
    SECTION("It is there")
    {
        CHECK(LoadRobots(*OpenStore(copy)).back() == "LR03");
    }
}

TEST_CASE("Store: one that was closed while another program read it is opened after that one has ended")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const auto readWhileClosing = [&file](const char* first, const char* second) {
        auto store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        SQLite::Database reader(file, SQLite::OPEN_READWRITE);
        reader.exec(first);
        reader.exec("SELECT * FROM plans");
        REQUIRE(store->Append(MakeBatch("LR02")).has_value());
        store.reset();
        reader.exec(second);
    };
    SECTION("One that looks now and then")
    {
        readWhileClosing("SELECT 1", "SELECT 1");
    }
    SECTION("One in the middle of a look")
    {
        readWhileClosing("BEGIN", "ROLLBACK");
    }
    REQUIRE_FALSE(Files::exists(file + "-wal"));
    CHECK(LoadRobots(*OpenStore(file)) == std::vector<std::string>{"LR01", "LR02"});
}

TEST_CASE("Store: a backup in the place of one that was not closed is asked about, and opened when it was closed")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    const std::string copy = folder.GetFile("copy.db");
    OpenStore(file);
    Files::copy_file(file, folder.GetFile("backup.db"));
    {
        const auto store = OpenStore(file);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        CopyAsKilled(file, copy);
    }
    Files::copy_file(folder.GetFile("backup.db"), file, Files::copy_options::overwrite_existing);
    CHECK(LoadRobots(*OpenStore(file)).empty());
    Files::remove(copy + "-wal");
    Files::copy_file(folder.GetFile("backup.db"), copy, Files::copy_options::overwrite_existing);
    RequireLost(copy);
    Files::remove(copy + ".lock");
    CHECK(LoadRobots(*OpenStore(copy)).empty());
}

TEST_CASE("Store: one that was killed while its log was folded needs the log")
{
    const StoreFolder folder;
    const std::string copy = folder.GetFile("copy.db");
    const auto store = OpenStore(folder.GetFile());
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(folder.GetFile(), copy);
    std::ofstream(copy + ".lock") << "open\n";
    SECTION("It is there")
    {
        CHECK(LoadRobots(*OpenStore(copy)) == std::vector<std::string>{"LR01"});
    }
    SECTION("It is not")
    {
        Files::remove(copy + "-wal");
        RequireLost(copy);
    }
}

TEST_CASE("Store: a new one in the place of one that was moved away without its mark is opened again after a crash")
{
    const StoreFolder folder;
    const std::string copy = folder.GetFile("copy.db");
    const auto store = OpenStore(folder.GetFile());
    std::ofstream(folder.GetFile("copy.db.lock")) << "log 7\n";
    const auto young = OpenStore(copy);
    CopyAsKilled(copy, folder.GetFile("killed.db"));
    OpenStore(folder.GetFile("killed.db"));
    REQUIRE(young->Append(MakeBatch("LR01")).has_value());
    CopyAsKilled(copy, folder.GetFile("later.db"));
    CHECK(LoadRobots(*OpenStore(folder.GetFile("later.db"))) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: one that was not closed and is refused is left as it is, with its log")
{
    const StoreFolder folder;
    const std::string copy = folder.GetFile("copy.db");
    {
        const auto store = OpenStore(folder.GetFile());
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        SQLite::Database(folder.GetFile(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
        CopyAsKilled(folder.GetFile(), copy);
    }
    const std::string before = ReadBytes(copy);
    const std::string log = ReadBytes(copy + "-wal");
    const auto refused = SqlitePlanStore::Open(copy);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreTooNew);
    CHECK((ReadBytes(copy) == before)); // too long to be shown
    CHECK((ReadBytes(copy + "-wal") == log));
}

TEST_CASE("Store: one that was closed needs no log, and a copy of a new one's file is a store")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    {
        const auto store = OpenStore(file);
        Files::copy_file(file, folder.GetFile("copy.db"));
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        CHECK(Files::file_size(file + ".lock") > 0);
    }
    CHECK(Files::file_size(file + ".lock") == 0);
    CHECK_FALSE(OpenStore(file)->GetOrigin().bNew);
    CHECK_FALSE(OpenStore(folder.GetFile("copy.db"))->GetOrigin().bNew);
}

TEST_CASE("Store: a file that lacks its tables, or has a version that cannot be, is told as damaged")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile();
    std::string found;
    const auto spoil = [&file](const char* statement) {
        SQLite::Database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(statement);
    };
    SECTION("No table at all")
    {
        spoil("CREATE TABLE plans (a); DROP TABLE plans");
        found = "without any table";
    }
    SECTION("One table is missing")
    {
        OpenStore(file);
        spoil("DROP TABLE reports");
        found = "no such table";
    }
    SECTION("Version 0")
    {
        OpenStore(file);
        spoil("PRAGMA user_version = 0");
        found = "version 0";
    }
    SECTION("A negative version")
    {
        OpenStore(file);
        spoil("PRAGMA user_version = -5");
        found = "version -5";
    }
    const auto refused = SqlitePlanStore::Open(file);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreCorrupt);
    const std::string text = Core::Describe(refused.error());
    INFO(text);
    CHECK(text.find(found) != std::string::npos);
    CHECK(text.find("put a backup there") != std::string::npos);
}

TEST_CASE("Store: to look at a store makes, changes and takes nothing, also while another program has it open")
{
    const StoreFolder folder;
    const std::string file = folder.GetFile("a store%20#1?.db");
    CHECK(*SqlitePlanStore::Inspect(file) == StoreOrigin{true, false, 0, NEWEST});
    CHECK(folder.ListNames().empty());
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(file);
        CHECK(store->GetOrigin() == StoreOrigin{true, false, 0, NEWEST});
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        const std::vector<std::string> before = folder.ListNames();
        CHECK(*SqlitePlanStore::Inspect(file) == StoreOrigin{false, false, NEWEST, NEWEST});
        CHECK(folder.ListNames() == before);
        CHECK(store->Append(MakeBatch("LR02")).has_value());
    }
    const std::vector<std::string> before = folder.ListNames();
    CHECK(before.size() == 2); // and its lock
    const auto time = Files::last_write_time(file);
    CHECK(*SqlitePlanStore::Inspect(file) == StoreOrigin{false, false, NEWEST, NEWEST});
    CHECK(folder.ListNames() == before);
    CHECK(Files::last_write_time(file) == time);
    CHECK(OpenStore(file)->GetOrigin() == StoreOrigin{false, false, NEWEST, NEWEST});
}

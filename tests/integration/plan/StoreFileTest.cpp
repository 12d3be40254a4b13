#include "ManualClock.hpp"
#include "StoreFolder.hpp"
#include <acs/plan/EPlanningError.hpp>

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

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;

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

TEST_CASE("Store: a file that lacks its tables, or has a version that cannot be, is told as damaged")
{
    struct Row
    {
        bool bStore; ///< It was one.
        const char* statement;
        const char* found;
    };
    const std::vector<Row> rows{
        {false, "CREATE TABLE plans (a); DROP TABLE plans", "without any table"},
        {true, "DROP TABLE reports", "no such table"},
        {true, "PRAGMA user_version = 0", "version 0"},
        {true, "PRAGMA user_version = -5", "version -5"}};
    for (const Row& row : rows)
    {
        INFO(row.statement);
        const StoreFolder folder;
        const std::string file = folder.GetFile();
        if (row.bStore)
        {
            OpenStore(file);
        }
        SQLite::Database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(row.statement);
        const auto refused = SqlitePlanStore::Open(file);
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreCorrupt);
        CHECK(Contains(Core::Describe(refused.error()), row.found));
        CHECK(Contains(Core::Describe(refused.error()), "put a backup there"));
    }
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

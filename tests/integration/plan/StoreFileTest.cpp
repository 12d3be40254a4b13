#include "ManualClock.hpp"
#include "StoreFolder.hpp"
#include "TightDisk.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <sys/stat.h>
#include <sys/syscall.h>
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

/// During its lifetime no file can be synchronised.
class BrokenDisk
{
public:
    BrokenDisk()
    {
        Get() = true;
    }

    BrokenDisk(const BrokenDisk&) = delete;
    BrokenDisk& operator=(const BrokenDisk&) = delete;

    ~BrokenDisk()
    {
        Get() = false;
    }

    /// Whether there is one.
    static bool& Get()
    {
        static bool bBroken = false;
        return bBroken;
    }
};

/// The files that a crash leaves.
std::string CopyStore(const StoreFolder& folder, const std::string& name)
{
    std::string copy = folder.GetStore(name);
    MakeDirectory(copy);
    Files::copy_file(GetDatabase(folder.GetStore()), GetDatabase(copy));
    Files::copy_file(GetLog(folder.GetStore()), GetLog(copy));
    return copy;
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming,readability-inconsistent-declaration-parameter-name): the system's own
extern "C" int fdatasync(int file)
{
    if (BrokenDisk::Get())
    {
        errno = EIO;
        return -1;
    }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
    return static_cast<int>(::syscall(SYS_fdatasync, file));
}

TEST_CASE("Store: a database that is removed while it is open is detected, copied, and restored by the next start")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = GetDatabase(directory);
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        CHECK(store->Check().has_value());
        Files::remove(file);
        CHECK(
            DescribeFailure(store->Check())
            == file + ": expected the file that was opened; put it back, or restart: everything stored is in " + file
                + ".rescued, which the next start restores, found " + file
                + " removed or moved away while it was open");
        CHECK(DescribeFailure(store->Append(MakeBatch("LR02"))) == DescribeFailure(store->Check()));
        CHECK_FALSE(Files::exists(file));
        CHECK_FALSE(SqlitePlanStore::Open(directory).has_value()); // this program has it open
        // A crash leaves the log, which belongs to no other database.
        Files::copy_file(GetLog(directory), folder.GetStore("log"));
    }
    Files::rename(folder.GetStore("log"), GetLog(directory));
    CHECK(*SqlitePlanStore::Inspect(directory) == StoreOrigin{false, true, 0, NEWEST});
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
    CHECK(store->GetOrigin() == StoreOrigin{false, true, NEWEST, NEWEST});
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01"});
    CHECK(store->Append(MakeBatch("LR02")).has_value());
    CHECK_FALSE(Files::exists(file + ".rescued"));
}

TEST_CASE("Store: a database that is put back is used again, and the copy is deleted")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = GetDatabase(directory);
    const bool bWhole = GENERATE(false, true); // the whole directory
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::rename(bWhole ? directory : file, folder.GetStore("away"));
        CHECK_FALSE(store->Append(MakeBatch("LR02")).has_value());
        CHECK(Files::exists(file + ".rescued") == !bWhole);
        Files::rename(folder.GetStore("away"), bWhole ? directory : file);
        CHECK(store->Append(MakeBatch("LR02")).has_value());
        CHECK(store->Check().has_value());
    }
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01", "LR02"});
    CHECK(StoreFolder::ListNamesIn(directory) == std::vector<std::string>{"acsd.db", "generation"});
}

TEST_CASE(
    "Store: another database in the place of the open one is never written, and the next start requires a decision")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = GetDatabase(directory);
    const std::string other = folder.GetStore("other");
    REQUIRE(OpenStore(other)->Append(MakeBatch("CR01")).has_value());
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::rename(GetDatabase(other), file);
        const std::string failure = DescribeFailure(store->Append(MakeBatch("LR02")));
        CHECK(Contains(failure, "found " + file + " replaced by another file"));
        CHECK(Contains(failure, "put it back, or move the other file away and restart"));
    }
    const std::string refusal = DescribeOpening(SqlitePlanStore::Open(directory));
    CHECK(refusal.starts_with(file + ": expected one database; "));
    CHECK(Contains(refusal, file + ".rescued"));
    CHECK(DescribeOpening(SqlitePlanStore::Inspect(directory)) == refusal);
    Files::rename(file, GetDatabase(other));
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01"});
    CHECK(LoadRobots(*OpenStore(other)) == std::vector<std::string>{"CR01"});
}

TEST_CASE("Store: a write-ahead log that is removed is detected, and its changes are merged into the database")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::rename(GetLog(directory), folder.GetStore("log"));
        const std::string failure = DescribeFailure(store->Check());
        CHECK(Contains(failure, "found " + GetLog(directory) + " removed or moved away"));
        CHECK(Contains(failure, "restart: everything stored is in the database"));
        CHECK_FALSE(store->Append(MakeBatch("LR02")).has_value());
        Files::copy(directory, folder.GetStore("crashed")); // as a crash would leave it
        Files::permissions(folder.GetStore("crashed"), Files::perms::owner_all);
        ForgetIdentity(folder.GetStore("crashed"));
        CHECK(LoadRobots(*OpenStore(folder.GetStore("crashed"))) == std::vector<std::string>{"LR01"});
        // Put back, the store works again, and the log is needed after a crash as before.
        Files::rename(folder.GetStore("log"), GetLog(directory));
        CHECK(store->Append(MakeBatch("LR02")).has_value());
        Files::copy(directory, folder.GetStore("later"));
        Files::permissions(folder.GetStore("later"), Files::perms::owner_all);
        ForgetIdentity(folder.GetStore("later"));
        Files::remove(GetLog(folder.GetStore("later")));
        CHECK_FALSE(SqlitePlanStore::Open(folder.GetStore("later")).has_value());
    }
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01", "LR02"});
}

TEST_CASE(
    "Store: if no copy can be made the failure states that all plans are lost with the program, and it is retried")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        Files::remove_all(directory);
        CHECK(Contains(
            DescribeFailure(store->Check()),
            "or all plans are lost: they cannot be copied: " + GetDatabase(directory)));
        MakeDirectory(directory);
        CHECK(Contains(DescribeFailure(store->Check()), "which the next start restores"));
    }
    CHECK(LoadRobots(*OpenStore(directory)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: a store that is opened by a link to its directory is watched and inspected by that link")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string link = folder.GetStore("link");
    MakeDirectory(directory);
    Files::create_directory_symlink(directory, link);
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(link + "/");
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    CHECK(store->Check().has_value());
    SQLite::Database(GetDatabase(directory), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99"); // into the log
    const Core::Result<StoreOrigin> seen = SqlitePlanStore::Inspect(link);
    REQUIRE_FALSE(seen.has_value());
    CHECK(seen.error().code == EPlanningError::StoreTooNew);
    Files::remove(GetLog(directory));
    CHECK(Contains(DescribeFailure(store->Check()), GetLog(link) + " removed"));
}

TEST_CASE("Store: each failure to open names the path, the reason and the remedy")
{
    struct Row
    {
        std::string store;
        std::string expected;
        std::string found;
        std::string file{}; ///< In the directory, where it is named.
    };
    const StoreFolder folder;
    std::ofstream(folder.GetStore("text")) << "not a database, and longer than an empty file";
    MakeDirectory(folder.GetStore("damaged"));
    Files::copy_file(folder.GetStore("text"), GetDatabase(folder.GetStore("damaged")));
    MakeDirectory(folder.GetStore("foreign"));
    SQLite::Database(GetDatabase(folder.GetStore("foreign")), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec("CREATE TABLE t (a)");
    OpenStore(folder.GetStore("new")).reset();
    SQLite::Database(GetDatabase(folder.GetStore("new")), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
    REQUIRE(::mkfifo(folder.GetStore("pipe").c_str(), 0600) == 0);
    MakeDirectory(folder.GetStore("linked"));
    Files::create_symlink(folder.GetStore("text"), GetDatabase(folder.GetStore("linked")));
    MakeDirectory(folder.GetStore("shared"));
    Files::permissions(folder.GetStore("shared"), Files::perms::owner_all | Files::perms::others_read);
    MakeDirectory(folder.GetStore("former"));
    std::ofstream(GetDatabase(folder.GetStore("former")) + ".lock").close();
    OpenStore(folder.GetStore("good")).reset();
    MakeDirectory(folder.GetStore("locked"));
    Files::permissions(folder.GetStore("locked"), Files::perms::owner_read | Files::perms::owner_exec);
    OpenStore(folder.GetStore("read-only")).reset();
    Files::permissions(GetDatabase(folder.GetStore("read-only")), Files::perms::owner_read);
    std::vector<Row> rows{
        {"none/store", "create the directory " + folder.GetStore("none"), "No such file or directory"},
        {"text/store", "create the directory " + folder.GetStore("text"), "Not a directory"},
        {"text", "an undamaged plan store; move it away", "file is not a database"},
        {"pipe", "a directory; give another path", "a device, pipe or socket"},
        {"shared", "set its mode to 0700", "mode 0704"},
        {"linked", "a regular file; move it away", "link", "/acsd.db"},
        {"former", "itself as the directory: it is migrated", "the former layout", "/acsd.db"},
        {"good/acsd.db", "give the directory of this database", "a database of such a directory"},
        {"damaged", "an undamaged plan store; move it away", "file is not a database", "/acsd.db"},
        {"foreign", "a plan store; give another path", "a database of another program", "/acsd.db"},
        {"new", "start the newer program that wrote it", "version 99", "/acsd.db"}};
    if (::geteuid() != 0) // who has all permissions
    {
        rows.push_back({"locked/store", "correct the owner or the mode of", "Permission denied"});
        rows.push_back({"locked", "correct its owner or its mode", "Permission denied"});
        rows.push_back({"read-only", "correct its owner or its mode", "Permission denied", "/acsd.db"});
    }
    const std::vector<std::string> before = folder.ListNames();
    for (const Row& row : rows)
    {
        INFO(row.store);
        const std::string store = folder.GetStore(row.store);
        const std::string failure = DescribeOpening(SqlitePlanStore::Inspect(store));
        INFO(failure);
        CHECK(failure.starts_with(store + row.file + ": expected "));
        CHECK(Contains(failure.substr(0, failure.find(", found ")), row.expected));
        CHECK(Contains(failure.substr(failure.find(", found ")), row.found));
        CHECK(DescribeOpening(SqlitePlanStore::Open(store)) == failure);
    }
    CHECK(folder.ListNames() == before);
    Files::permissions(folder.GetStore("locked"), Files::perms::owner_all);
}

TEST_CASE(
    "Store: a write that fails names the path, the reason and the remedy, and the next one succeeds: another program's lock")
{
    const StoreFolder folder;
    const std::string file = GetDatabase(folder.GetStore());
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
    {
        SQLite::Database other(file, SQLite::OPEN_READWRITE);
        const SQLite::Transaction locks(other, SQLite::TransactionBehavior::IMMEDIATE);
        const std::string failure = DescribeFailure(store->Append(MakeBatch("LR01")));
        CHECK(failure.starts_with(file + ": expected a database that no other program locks; close that program"));
        CHECK(Contains(failure, "found writing failed: database is locked"));
    }
    CHECK(store->Append(MakeBatch("LR01")).has_value());
}

TEST_CASE(
    "Store: a write that fails names the path, the reason and the remedy, and the next one succeeds: the system takes no more")
{
    const StoreFolder folder;
    const std::string file = GetDatabase(folder.GetStore());
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    const auto failed = [&store, &folder] {
        const TightDisk disk(Files::file_size(GetLog(folder.GetStore())));
        return store->Append(MakeBatch("LR02"));
    }();
    const std::string failure = DescribeFailure(failed);
    CHECK(failure.starts_with(file + ": expected a disk that reads and writes; check it and the system log"));
    INFO(failure);
    CHECK(Contains(failure, "found writing failed: disk I/O error (File too large)"));
    CHECK(store->Append(MakeBatch("LR02")).has_value());
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01", "LR02"});
}

TEST_CASE("Store: a store that could not be created on a full disk is created when there is space")
{
    for (const std::uintmax_t room : {0U, 1U, 4U, 5U, 8U, 16U, 24U, 32U, 40U, 64U})
    {
        INFO(room << " KiB");
        const StoreFolder folder;
        bool bMade = false;
        {
            const TightDisk disk(room * 1024);
            bMade = SqlitePlanStore::Open(folder.GetStore()).has_value();
        }
        CHECK((room > 32 || !bMade));
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
        CHECK(store->Append(MakeBatch("LR01")).has_value());
    }
}

TEST_CASE("Store: a file that lacks its tables, or has an impossible version, is reported as damaged")
{
    struct Row
    {
        bool bStore; ///< The database is that of a store.
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
        MakeDirectory(folder.GetStore());
        if (row.bStore)
        {
            OpenStore(folder.GetStore());
        }
        SQLite::Database(GetDatabase(folder.GetStore()), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
            .exec(row.statement);
        const auto refused = SqlitePlanStore::Open(folder.GetStore());
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreCorrupt);
        CHECK(Contains(Core::Describe(refused.error()), row.found));
        CHECK(Contains(Core::Describe(refused.error()), "restore a backup with acsd store restore"));
    }
}

TEST_CASE("Store: an inspection creates, changes and locks nothing, also while another program has the store open")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore("a store%20#1?");
    CHECK(*SqlitePlanStore::Inspect(directory) == StoreOrigin{true, false, 0, NEWEST});
    CHECK(folder.ListNames().empty());
    {
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
        CHECK(Files::status(directory).permissions() == Files::perms::owner_all);
        CHECK(store->GetOrigin() == StoreOrigin{true, false, 0, NEWEST});
        REQUIRE(store->Append(MakeBatch("LR01")).has_value());
        const std::vector<std::string> before = StoreFolder::ListNamesIn(directory);
        CHECK(*SqlitePlanStore::Inspect(directory) == StoreOrigin{false, false, NEWEST, NEWEST});
        CHECK(StoreFolder::ListNamesIn(directory) == before);
        CHECK(store->Append(MakeBatch("LR02")).has_value());
    }
    const std::vector<std::string> before = StoreFolder::ListNamesIn(directory);
    CHECK(before == std::vector<std::string>{"acsd.db", "generation"});
    const auto time = Files::last_write_time(GetDatabase(directory));
    CHECK(*SqlitePlanStore::Inspect(directory) == StoreOrigin{false, false, NEWEST, NEWEST});
    CHECK(StoreFolder::ListNamesIn(directory) == before);
    CHECK(Files::last_write_time(GetDatabase(directory)) == time);
    CHECK(OpenStore(directory)->GetOrigin() == StoreOrigin{false, false, NEWEST, NEWEST});
}

TEST_CASE("Store: an open store keeps its path for itself, and fails for good when another program has taken it")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    Files::rename(directory, folder.GetStore("away"));
    CHECK(store->Check().error().code == EPlanningError::StoreFailed);
    const auto openOther = [](const std::string& path) {
        return SqlitePlanStore::Open(path).error().code;
    };
    SECTION("A directory in its place is locked")
    {
        MakeDirectory(directory);
        CHECK(store->Check().error().code == EPlanningError::StoreFailed);
        CHECK(openOther(directory) == EPlanningError::StoreTaken);
        CHECK(openOther(folder.GetStore("away")) == EPlanningError::StoreTaken);
        Files::remove_all(directory);
        Files::rename(folder.GetStore("away"), directory);
        CHECK(store->Append(MakeBatch("LR02")).has_value());
        CHECK(openOther(directory) == EPlanningError::StoreTaken);
    }
    SECTION("Another program has the directory in its place")
    {
        const std::unique_ptr<SqlitePlanStore> other = OpenStore(directory);
        for (const Core::Result<void>& result : {store->Check(), store->Append(MakeBatch("LR02"))})
        {
            REQUIRE_FALSE(result.has_value());
            CHECK(result.error().code == EPlanningError::StoreTaken);
        }
        CHECK(
            StoreFolder::ListNamesIn(directory)
            == std::vector<std::string>{"acsd.db", "acsd.db-shm", "acsd.db-wal", "generation"});
        CHECK(other->Append(MakeBatch("CR01")).has_value());
    }
}

TEST_CASE("Store: a commit that cannot be synchronised may be stored, until the next one overwrites it")
{
    const StoreFolder folder;
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    {
        const BrokenDisk disk;
        CHECK(store->Append(MakeBatch("LR02")).error().code == EPlanningError::StoreOutcomeUnknown);
        CHECK(store->Append(MakeBatch("LR03")).error().code == EPlanningError::StoreOutcomeUnknown);
    }
    const std::string before = CopyStore(folder, "before");
    REQUIRE(store->Append(MakeBatch("LR04")).has_value());
    const std::string after = CopyStore(folder, "after");
    CHECK(LoadRobots(*AcceptStore(before)) == std::vector<std::string>{"LR01", "LR03"});
    CHECK(LoadRobots(*AcceptStore(after)) == std::vector<std::string>{"LR01", "LR04"});
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01", "LR04"});
}

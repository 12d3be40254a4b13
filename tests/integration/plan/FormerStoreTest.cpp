#include "StoreFolder.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;

constexpr int FORMER_SCHEMA = 3;

/// A closed database of the former layout: robot LR01 is in maintenance.
void MakeFormerStore(const StoreFolder& folder, const std::string& file)
{
    const std::string source = folder.GetStore("source");
    REQUIRE(OpenStore(source)->Append(MakeBatch("LR01")).has_value());
    Files::rename(GetDatabase(source), file);
    Files::remove_all(source);
    SQLite::Database database(file, SQLite::OPEN_READWRITE);
    database.exec(
        "DELETE FROM settings; DROP TABLE blocks; DROP TABLE receipts; PRAGMA user_version = "
        + std::to_string(FORMER_SCHEMA));
    std::ofstream(file + ".lock").close();
}

/// The files of a program of the former layout that was killed: that CR01 is in maintenance is in the log only.
void MakeKilledFormerStore(const StoreFolder& folder, const std::string& file)
{
    const std::string running = folder.GetStore("running.db");
    MakeFormerStore(folder, running);
    {
        SQLite::Database database(running, SQLite::OPEN_READWRITE);
        database.exec("INSERT INTO settings VALUES ('log_number', '7'); INSERT INTO maintenance VALUES ('CR01')");
        Files::copy_file(running, file);
        Files::copy_file(running + "-wal", file + "-wal");
        std::ofstream(file + ".lock") << "log 7\n";
    }
    Files::remove(running);
    Files::remove(running + ".lock");
}

const std::vector<std::string>& GetMigratedNames()
{
    static const std::vector<std::string> NAMES{"acsd.db", "acsd.db.former", "acsd.db.former.lock"};
    return NAMES;
}

} // namespace

TEST_CASE("Store: a store of the former layout becomes a directory, and its files are kept next to it")
{
    const StoreFolder folder;
    const std::string path = folder.GetStore("acsd.db");
    MakeFormerStore(folder, path);
    const std::vector<std::string> before = folder.ListNames();
    const StoreOrigin migrated{false, false, FORMER_SCHEMA, NEWEST, true};
    SECTION("As it is")
    {
        CHECK(*SqlitePlanStore::Inspect(path) == migrated);
        CHECK(folder.ListNames() == before);
        CHECK(OpenStore(path)->GetOrigin() == migrated);
        CHECK(folder.ListNames() == GetMigratedNames());
        CHECK(Files::status(path).permissions() == Files::perms::owner_all);
    }
    SECTION("By a link")
    {
        Files::create_symlink(path, folder.GetStore("link"));
        CHECK(OpenStore(folder.GetStore("link"))->GetOrigin() == migrated);
    }
    SECTION("A migration was interrupted while it copied")
    {
        MakeDirectory(path + ".migrating");
        std::ofstream(GetDatabase(path + ".migrating")) << "the beginning";
        CHECK(OpenStore(path)->GetOrigin() == migrated);
        CHECK(folder.ListNames() == GetMigratedNames());
    }
    SECTION("A migration was interrupted while it renamed")
    {
        Files::copy_file(path, folder.GetStore("copy"));
        OpenStore(path);
        Files::remove_all(path);
        MakeDirectory(path + ".migrating");
        Files::rename(folder.GetStore("copy"), GetDatabase(path + ".migrating"));
        Files::rename(path + ".former.lock", path + ".lock");
        CHECK(*SqlitePlanStore::Inspect(path) == migrated);
        CHECK(OpenStore(path)->GetOrigin().bMigrated);
        CHECK(folder.ListNames() == GetMigratedNames());
    }
    CHECK(*SqlitePlanStore::Inspect(path) == StoreOrigin{false, false, NEWEST, NEWEST});
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(path);
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01"});
    CHECK(store->Append(MakeBatch("CR01")).has_value());
}

TEST_CASE("Store: a store of the former layout that was not closed is migrated with its log, and refused without it")
{
    const StoreFolder folder;
    const std::string path = folder.GetStore("acsd.db");
    MakeKilledFormerStore(folder, path);
    SECTION("The log is there")
    {
        CHECK(LoadRobots(*OpenStore(path)) == std::vector<std::string>{"CR01", "LR01"});
        CHECK(Files::exists(path + ".former-wal"));
        CHECK_FALSE(Files::exists(path + "-wal"));
    }
    SECTION("The log is missing, or another program was merging it")
    {
        Files::remove(path + "-wal");
        if (GENERATE(false, true))
        {
            std::ofstream(path + ".lock") << "open\n";
        }
        const std::vector<std::string> before = folder.ListNames();
        const auto refused = SqlitePlanStore::Open(path);
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreCorrupt);
        CHECK(Contains(
            Core::Describe(refused.error()),
            "the log " + path + "-wal, which has the latest changes because the store was not closed"));
        CHECK_FALSE(SqlitePlanStore::Inspect(path).has_value());
        CHECK(folder.ListNames() == before);
        Files::remove(path + ".lock");
        CHECK(LoadRobots(*OpenStore(path)) == std::vector<std::string>{"LR01"});
    }
    SECTION("The database is missing")
    {
        Files::remove(path);
        for (const Core::Error& error : {SqlitePlanStore::Open(path).error(), SqlitePlanStore::Inspect(path).error()})
        {
            CHECK(error.code == EPlanningError::StoreCorrupt);
            CHECK(Contains(Core::Describe(error), path + "-wal belongs; put that file back"));
        }
    }
}

TEST_CASE("Store: a store of the former layout that another program has open is not migrated")
{
    const StoreFolder folder;
    const std::string path = folder.GetStore("acsd.db");
    MakeFormerStore(folder, path);
    const std::vector<std::string> before = folder.ListNames();
    const int lock = ::open((path + ".lock").c_str(), O_RDWR | O_CLOEXEC); // NOLINT: the system's own signature
    REQUIRE(::flock(lock, LOCK_EX | LOCK_NB) == 0);
    const auto refused = SqlitePlanStore::Open(path);
    ::close(lock);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreTaken);
    CHECK(Contains(Core::Describe(refused.error()), "another program"));
    CHECK(folder.ListNames() == before);
    CHECK(LoadRobots(*OpenStore(path)) == std::vector<std::string>{"LR01"});
}

TEST_CASE("Store: the copy of a database of the former layout that was removed while it was open is migrated")
{
    const StoreFolder folder;
    const std::string path = folder.GetStore("acsd.db");
    MakeFormerStore(folder, path);
    Files::rename(path, path + ".rescued");
    const bool bBoth = GENERATE(false, true);
    if (bBoth)
    {
        Files::copy_file(path + ".rescued", path);
        CHECK(Contains(Core::Describe(SqlitePlanStore::Inspect(path).error()), path + ": expected one database"));
        CHECK_FALSE(SqlitePlanStore::Open(path).has_value());
        Files::remove(path);
    }
    const StoreOrigin migrated{false, true, FORMER_SCHEMA, NEWEST, true};
    CHECK(*SqlitePlanStore::Inspect(path) == migrated);
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(path);
    CHECK(store->GetOrigin() == migrated);
    CHECK(LoadRobots(*store) == std::vector<std::string>{"LR01"});
    CHECK(Files::exists(path + ".former.rescued"));
}

#include "StoreFolder.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;

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

} // namespace

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

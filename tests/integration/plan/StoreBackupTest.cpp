#include "StoreFolder.hpp"
#include "TightDisk.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan_sqlite/StoreBackup.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

namespace Files = std::filesystem;
using Robots = std::vector<std::string>;

std::string DescribeRefusal(const std::string& directory)
{
    const auto refused = SqlitePlanStore::Open(directory);
    REQUIRE_FALSE(refused.has_value());
    CHECK(Core::Describe(SqlitePlanStore::Inspect(directory).error()) == Core::Describe(refused.error()));
    return Core::Describe(refused.error());
}

/// A closed store with this robot in maintenance.
void MakeStore(const std::string& directory, const std::string& robotID)
{
    REQUIRE(OpenStore(directory)->Append(MakeBatch(robotID)).has_value());
}

} // namespace

TEST_CASE(
    "Store: a copy of a whole directory is refused until it is accepted; a directory that is renamed is not a copy")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string copy = folder.GetStore("copy");
    MakeStore(directory, "LR01");
    Files::copy(directory, copy);
    Files::permissions(copy, Files::perms::owner_all);
    const std::string refusal = DescribeRefusal(copy);
    CHECK(Contains(refusal, "run acsd store accept " + copy + ": the TSC is then paused"));
    CHECK(Contains(refusal, "found a copy of the database that was used last"));
    CHECK(LoadRobots(*AcceptStore(copy)) == Robots{"LR01"});
    CHECK(OpenStore(copy)->Load()->holdReason == HOLD_REASON);

    Files::rename(directory, folder.GetStore("renamed"));
    CHECK(OpenStore(folder.GetStore("renamed"))->Load()->holdReason.empty());
}

TEST_CASE("Store: a database without its generation file is refused until it is accepted")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    MakeStore(directory, "LR01");
    Files::remove(GetGeneration(directory));
    CHECK(Contains(DescribeRefusal(directory), "found a copied or restored database, without the file generation"));
    CHECK(LoadRobots(*AcceptStore(directory)) == Robots{"LR01"});
    OpenStore(directory);
}

TEST_CASE("Store: what was held is held until the TSC is Auto")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    MakeStore(directory, "LR01");
    Files::remove(GetGeneration(directory));
    AcceptStore(directory);
    {
        const auto store = OpenStore(directory);
        REQUIRE(store->Append({{TscChanged{ETscState::Paused}}}).has_value());
        CHECK(store->Load()->holdReason == HOLD_REASON);
        REQUIRE(store->Append({{TscChanged{ETscState::Auto}}}).has_value());
        CHECK(store->Load()->holdReason.empty());
    }
    CHECK(OpenStore(directory)->Load()->holdReason.empty());
}

TEST_CASE("Store: there is nothing to accept in a directory without a database")
{
    const StoreFolder folder;
    CHECK_FALSE(SqlitePlanStore::Accept(folder.GetStore(), HOLD_REASON).has_value());
    CHECK(folder.ListNames().empty());
}

TEST_CASE("Store: a backup has what was stored, also while the store is open or was not closed, in one file")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = folder.GetStore("backup");
    std::unique_ptr<SqlitePlanStore> store = OpenStore(directory);
    REQUIRE(store->Append(MakeBatch("LR01")).has_value());
    const bool bOpen = GENERATE(true, false);
    if (!bOpen)
    {
        store.reset();
    }
    REQUIRE(BackUpStore(directory, file).has_value());
    CHECK(folder.ListNames() == std::vector<std::string>{"backup", "store"});
    CHECK(Contains(Core::Describe(BackUpStore(directory, file).error()), "a new file"));
    if (bOpen)
    {
        CHECK(store->Append(MakeBatch("LR02")).has_value());
        store.reset();
    }
    const std::string other = folder.GetStore("other");
    REQUIRE(RestoreStore(other, file).has_value());
    CHECK(LoadRobots(*AcceptStore(other)) == Robots{"LR01"});
    CHECK(LoadRobots(*OpenStore(directory)).size() == (bOpen ? 2 : 1));
}

TEST_CASE("Store: a restored backup is refused until it is accepted, and the previous database is kept with its log")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = folder.GetStore("backup");
    MakeStore(directory, "LR01");
    REQUIRE(BackUpStore(directory, file).has_value());
    {
        const auto store = OpenStore(directory);
        REQUIRE(store->Append(MakeBatch("LR02")).has_value());
        CHECK(RestoreStore(directory, file).error().code == EPlanningError::StoreTaken);
        Files::copy(directory, folder.GetStore("killed"));
    }
    const std::string killed = folder.GetStore("killed");
    Files::permissions(killed, Files::perms::owner_all);
    REQUIRE(RestoreStore(killed, file).has_value());
    CHECK(
        StoreFolder::ListNamesIn(killed)
        == std::vector<std::string>{"acsd.db", "acsd.db.previous", "acsd.db.previous-wal", "generation"});
    CHECK(Contains(DescribeRefusal(killed), "found a database of another generation"));
    CHECK(LoadRobots(*AcceptStore(killed)) == Robots{"LR01"});
    SQLite::Database previous(GetDatabase(killed) + ".previous", SQLite::OPEN_READWRITE);
    CHECK(previous.execAndGet("SELECT count(*) FROM maintenance").getInt() == 2);
    CHECK(Contains(
        Core::Describe(RestoreStore(killed, file).error()),
        "no database of an earlier restore; move it away"));
}

TEST_CASE("Store: what is no plan store is not restored, and the store is unchanged")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    MakeStore(directory, "LR01");
    std::ofstream(folder.GetStore("text")) << "not a database, and longer than an empty file";
    std::ofstream(folder.GetStore("empty")).flush();
    SQLite::Database(folder.GetStore("foreign"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec("CREATE TABLE t (a)");
    for (const char* name : {"text", "empty", "foreign", "missing"})
    {
        INFO(name);
        CHECK_FALSE(RestoreStore(directory, folder.GetStore(name)).has_value());
    }
    CHECK(LoadRobots(*OpenStore(directory)) == Robots{"LR01"});
}

TEST_CASE("Store: a trigger in the file reads no table of the system")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    MakeStore(directory, "LR01");
    SQLite::Database(GetDatabase(directory), SQLite::OPEN_READWRITE)
        .exec("CREATE TRIGGER t AFTER INSERT ON maintenance BEGIN "
              "INSERT OR REPLACE INTO settings SELECT 'leak', file FROM pragma_database_list; END");
    const auto store = OpenStore(directory);
    const Core::Result<void> stored = store->Append(MakeBatch("LR02"));
    REQUIRE_FALSE(stored.has_value());
    CHECK(Contains(Core::Describe(stored.error()), "unsafe use of virtual table"));
}

TEST_CASE("Store: a backup or restore that fails names the file that it is about")
{
    const StoreFolder folder;
    const std::string directory = folder.GetStore();
    const std::string file = folder.GetStore("backup");
    MakeStore(directory, "LR01");
    const std::vector<std::string> files = StoreFolder::ListNamesIn(directory);
    const auto describe = [](const Core::Result<void>& result) {
        REQUIRE_FALSE(result.has_value());
        return Core::Describe(result.error());
    };
    CHECK(describe(RestoreStore(directory, file)).starts_with(file + ": expected an existing backup"));
    CHECK(describe(BackUpStore(folder.GetStore("none"), file)).starts_with(GetDatabase(folder.GetStore("none"))));
    const std::string lost = folder.GetStore("none") + "/backup";
    CHECK(describe(BackUpStore(directory, lost)).starts_with(lost + ".part: expected "));
    REQUIRE(BackUpStore(directory, file).has_value());
    Files::resize_file(file, Files::file_size(file) / 2);
    CHECK(describe(RestoreStore(directory, file)).starts_with(file + ": expected an undamaged backup"));
    CHECK(describe(BackUpStore(file, lost)).starts_with(file + ": expected a directory; give that of the store"));
    {
        const TightDisk disk(8'192);
        const std::string full = folder.GetStore("full");
        CHECK(
            describe(BackUpStore(directory, full)).starts_with(full + ".part: expected a disk that reads and writes"));
        CHECK(describe(RestoreStore(directory, file)).starts_with(file));
    }
    CHECK(folder.ListNames() == std::vector<std::string>{"backup", "store"}); // no part of a copy
    CHECK(StoreFolder::ListNamesIn(directory) == files);
    CHECK(LoadRobots(*OpenStore(directory)) == Robots{"LR01"});
}

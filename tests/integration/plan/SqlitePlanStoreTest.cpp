#include "ManualClock.hpp"
#include "StoreFolder.hpp"
#include "StoreSamples.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

/// The database of version 1, with one row of each kind.
constexpr const char* FIRST_SCHEMA =
    "CREATE TABLE plans (sequence INTEGER PRIMARY KEY, plan_id TEXT NOT NULL UNIQUE, accepted_at INTEGER NOT NULL,"
    "  plan TEXT NOT NULL, state TEXT NOT NULL, progress TEXT NOT NULL);"
    "CREATE INDEX plans_by_state ON plans (state);"
    "CREATE TABLE reports (sequence INTEGER PRIMARY KEY AUTOINCREMENT, transaction_id TEXT NOT NULL UNIQUE,"
    "  time INTEGER NOT NULL, report TEXT NOT NULL);"
    "CREATE TABLE carriers (robot_id TEXT PRIMARY KEY, carriers TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE alarms (robot_id TEXT NOT NULL, error_code TEXT NOT NULL, plan_id TEXT NOT NULL,"
    "  job_id TEXT NOT NULL, alarm TEXT NOT NULL, PRIMARY KEY (robot_id, error_code, plan_id, job_id)) WITHOUT ROWID;"
    R"(INSERT INTO plans VALUES (1, 'P1', 0, '{"planId":"P1","lotId":"L","steps":[{"stepNo":1,"action":"CassetteLoad",)"
    R"("position":"A01.CP01","carrierIds":["C1"],"jobs":[{"jobId":"J1","from":"A01.CP01","to":"AMR.CP01"}]}]}',)"
    R"('InProgress', '{"state":"InProgress","robotId":"LR01","message":"",)"
    R"("steps":[{"state":"InProgress","jobs":["InProgress"]}]}');)"
    R"(INSERT INTO reports VALUES (7, 'T', 0, '{"kind":"Plan","planId":"P1","planState":"InProgress","message":""}');)"
    R"(INSERT INTO carriers VALUES ('LR01', '{"robotId":"LR01","carrierIds":[null]}');)"
    R"(INSERT INTO alarms VALUES ('LR01', 'ACS-1002', '', '',)"
    R"( '{"robotId":"LR01","errorCode":"ACS-1002","level":"Heavy","message":"lost"}');)";
constexpr const char* SECOND_SCHEMA =
    "CREATE TABLE settings (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "INSERT INTO settings VALUES ('tsc_state', 'Paused');";

} // namespace

TEST_CASE("Store: an empty file becomes a store with a schema version, in a write-ahead log")
{
    const StoreFolder folder;
    MakeDirectory(folder.GetStore());
    std::ofstream(GetDatabase(folder.GetStore())).close();
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
    CHECK(*store->Load() == StoredState{});
    SQLite::Database database(GetDatabase(folder.GetStore()), SQLite::OPEN_READONLY);
    CHECK(database.execAndGet("PRAGMA user_version").getInt() == NEWEST);
    CHECK(database.execAndGet("PRAGMA journal_mode").getString() == "wal");
}

TEST_CASE("Store: databases of the first and second schema are migrated without loss")
{
    for (const int version : {1, 2})
    {
        INFO("version " << version);
        const StoreFolder folder;
        MakeDirectory(folder.GetStore());
        {
            SQLite::Database database(GetDatabase(folder.GetStore()), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
            database.exec(FIRST_SCHEMA);
            if (version == 2)
            {
                database.exec(SECOND_SCHEMA);
            }
            database.exec("PRAGMA application_id = 0x41435350; PRAGMA user_version = " + std::to_string(version));
        }
        std::ofstream(GetGeneration(folder.GetStore())) << "-\n"; // as the migration of the former layout writes it
        const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
        const Core::Result<StoredState> loaded = store->Load();
        REQUIRE(loaded.has_value());
        REQUIRE(loaded->plans.size() == 1);
        CHECK(loaded->plans.front().plan.planID == "P1");
        CHECK(loaded->plans.front().progress.state == EPlanState::InProgress);
        CHECK(loaded->plans.front().transactionID.empty());
        CHECK_FALSE(loaded->plans.front().progress.control.has_value());
        CHECK(loaded->outbox.size() == 1);
        CHECK(loaded->lastReportSequence == 7);
        CHECK(loaded->alarms.size() == 1);
        CHECK(loaded->carriers.size() == 1);
        CHECK(loaded->robotWorks.empty());
        CHECK(loaded->tscState.value_or(ETscState::Auto) == (version == 2 ? ETscState::Paused : ETscState::Auto));
        REQUIRE(store->Append(
            {{PlanAdded{MakeRecord(2, "P2")},
              RobotWorkChanged{"LR01", "C", {}, {}, {}, false, false, {"N1"}, false, 0, {}, {}}}}));
        CHECK(store->Load()->plans.back().transactionID == "request-P2");
        CHECK(store->Load()->blocks.empty());
        CHECK(store->Load()->robotWorks.size() == 1);
    }
}

TEST_CASE("Store: a database of the fourth schema, without blocks and receipts, is migrated without loss")
{
    const StoreFolder folder;
    MemoryPlanStore memory;
    const StoreBatch batch = MakeBatches().front();
    REQUIRE(memory.Append(batch).has_value());
    REQUIRE(OpenStore(folder.GetStore())->Append(batch).has_value());
    {
        SQLite::Database database(GetDatabase(folder.GetStore()), SQLite::OPEN_READWRITE);
        database.exec("DROP TABLE blocks; DROP TABLE receipts; PRAGMA user_version = 4");
    }
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
    CHECK(store->GetOrigin().foundVersion == 4);
    CHECK(*store->Load() == memory.GetState());
    const Block block{EBlockKind::Node, "L03", "oil", Testing::ManualClock().GetNow().wall};
    REQUIRE(store->Append({{BlockAdded{block}}}).has_value());
    CHECK(store->Load()->blocks == std::vector<Block>{block});
}

TEST_CASE("Store: damage, another program's file and a newer version are distinguished and left unchanged")
{
    const StoreFolder folder;
    const std::string file = GetDatabase(folder.GetStore());
    MakeDirectory(folder.GetStore());
    const auto refuse = [&folder, &file](EPlanningError error) {
        const std::uintmax_t size = std::filesystem::file_size(file);
        const Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(folder.GetStore());
        REQUIRE_FALSE(store.has_value());
        CHECK(store.error().code == error);
        CHECK(Core::Describe(store.error()).find(file) != std::string::npos);
        CHECK(std::filesystem::file_size(file) == size);
    };
    SECTION("no database")
    {
        std::ofstream(file) << std::string(8192, 'x');
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("a damaged page")
    {
        {
            const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetStore());
            for (std::uint64_t sequence = 1; sequence <= 100; ++sequence)
            {
                const PlanRecord record = MakeRecord(sequence, "P" + std::to_string(sequence));
                REQUIRE(store->Append({{PlanAdded{record}}}).has_value());
            }
        }
        std::fstream damage(file, std::ios::in | std::ios::out | std::ios::binary);
        damage.seekp(3 * 4096);
        damage << std::string(4096, 'x');
        damage.close();
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("another program's")
    {
        SQLite::Database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE a (b)");
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("a newer version")
    {
        static_cast<void>(OpenStore(folder.GetStore()));
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
        refuse(EPlanningError::StoreTooNew);
    }
    SECTION("a row that cannot be read")
    {
        REQUIRE(OpenStore(folder.GetStore())->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec("UPDATE plans SET progress = '{}'");
        const Core::Result<StoredState> loaded = OpenStore(folder.GetStore())->Load();
        REQUIRE_FALSE(loaded.has_value());
        CHECK(loaded.error().code == EPlanningError::StoreCorrupt);
        CHECK(loaded.error().found.find("plan P1") != std::string::npos);
    }
}

TEST_CASE("Store: a directory is used by one program at a time, and is free again when that one has closed it")
{
    const StoreFolder folder;
    {
        const std::unique_ptr<SqlitePlanStore> first = OpenStore(folder.GetStore());
        const Core::Result<std::unique_ptr<SqlitePlanStore>> second = SqlitePlanStore::Open(folder.GetStore());
        REQUIRE_FALSE(second.has_value());
        CHECK(second.error().code == EPlanningError::StoreTaken);
        CHECK(second.error().path == folder.GetStore());
        CHECK(Core::Describe(second.error()).find("another program") != std::string::npos);
        const std::string link = folder.GetStore("link");
        std::filesystem::create_directory_symlink(folder.GetStore(), link);
        CHECK_FALSE(SqlitePlanStore::Open(link).has_value());
        CHECK(first->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    }
    CHECK(OpenStore(folder.GetStore())->Load()->plans.size() == 1);
}

TEST_CASE("Store: a missing parent directory is an error that names the store directory")
{
    const Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open("/nonexistent/store");
    REQUIRE_FALSE(store.has_value());
    CHECK(store.error().code == EPlanningError::StoreFailed);
    CHECK(store.error().path == "/nonexistent/store");
}

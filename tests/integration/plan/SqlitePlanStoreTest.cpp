#include "Catch.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include "TemporaryFolder.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)

namespace
{

class StoreFolder : public Testing::TemporaryFolder
{
public:
    [[nodiscard]] std::string GetFile() const
    {
        return (GetPath() / "acsd.db").string();
    }
};

PlanRecord MakeRecord(std::uint64_t sequence, const std::string& planID)
{
    PlanRecord record;
    record.sequence = sequence;
    record.acceptedAt = Testing::ManualClock().GetNow().wall;
    record.plan = {planID, "LOT", 3, {{1, "CassetteLoad", "A01.CP01", {"C1"}, {{"J1", "A01.CP01", "AMR.CP01"}}}}};
    record.progress.steps = {{EStepState::Pending, {EJobState::Pending}}};
    return record;
}

OutboxEntry MakeEntry(std::uint64_t sequence, const std::string& planID)
{
    return {
        sequence,
        "transaction-" + std::to_string(sequence),
        Testing::ManualClock().GetNow().wall,
        PlanReport{planID, EPlanState::InProgress, ""}};
}

const Alarm& GetAlarm()
{
    static const Alarm ALARM{"LR01", "ACS-1001", EAlarmLevel::Heavy, "look", "P1", 1, "J1"};
    return ALARM;
}

/// Something of every kind, in four batches.
std::vector<StoreBatch> MakeBatches()
{
    PlanProgressed progressed{"P1", MakeRecord(1, "P1").progress};
    progressed.progress.state = EPlanState::InProgress;
    progressed.progress.robotID = "LR01";
    progressed.progress.startedAt = Testing::ManualClock().GetNow().wall;
    return {
        {{PlanAdded{MakeRecord(1, "P1")}, PlanAdded{MakeRecord(2, "P2")}, PlanAdded{MakeRecord(3, "P3")}}},
        {{progressed,
          ReportAdded{MakeEntry(1, "P1")},
          ReportAdded{MakeEntry(2, "P1")},
          AlarmSet{GetAlarm()},
          CarriersChanged{"LR01", {std::nullopt}}}},
        {{PlanRemoved{3}, TscChanged{ETscState::Pausing}}},
        {{ReportRemoved{1}, CarriersChanged{"LR01", {"C1"}}, ReportAdded{MakeEntry(3, "P1")}, ReportRemoved{3}}}};
}

std::unique_ptr<SqlitePlanStore> OpenStore(const std::string& file)
{
    Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(file);
    REQUIRE(store.has_value());
    return std::move(*store);
}

} // namespace

TEST_CASE("Store: what was appended is there after the file was closed and opened, as the store in memory has it")
{
    const StoreFolder folder;
    MemoryPlanStore memory;
    for (const StoreBatch& batch : MakeBatches())
    {
        REQUIRE(OpenStore(folder.GetFile())->Append(batch).has_value());
        REQUIRE(memory.Append(batch).has_value());
    }
    const Core::Result<StoredState> loaded = OpenStore(folder.GetFile())->Load();
    REQUIRE(loaded.has_value());
    CHECK(*loaded == memory.GetState());
    CHECK(loaded->lastReportSequence == 3);
    CHECK(loaded->plans.size() == 2);
    CHECK(loaded->tscState == ETscState::Pausing);

    REQUIRE(OpenStore(folder.GetFile())->Append({{AlarmCleared{GetAlarm()}}}).has_value());
    CHECK(OpenStore(folder.GetFile())->Load()->alarms.empty());
}

TEST_CASE("Store: an empty file becomes a store with a schema version, in a write-ahead log")
{
    const StoreFolder folder;
    std::ofstream(folder.GetFile()).close();
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
    CHECK(*store->Load() == StoredState{});
    SQLite::Database database(folder.GetFile(), SQLite::OPEN_READONLY);
    CHECK(database.execAndGet("PRAGMA user_version").getInt() == 2);
    CHECK(database.execAndGet("PRAGMA journal_mode").getString() == "wal");
}

TEST_CASE("Store: a planID whose plan was removed can be stored again, in the same batch too")
{
    const StoreFolder folder;
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
    REQUIRE(store->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    REQUIRE(store->Append({{PlanRemoved{1}, PlanAdded{MakeRecord(2, "P1")}}}).has_value());
    REQUIRE(store->Load()->plans.size() == 1);
    CHECK(store->Load()->plans.front().sequence == 2);
}

TEST_CASE("Store: a file of the first schema is brought forward, and nothing of it is lost")
{
    const StoreFolder folder;
    REQUIRE(OpenStore(folder.GetFile())->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    {
        SQLite::Database database(folder.GetFile(), SQLite::OPEN_READWRITE);
        database.exec("DROP TABLE settings; PRAGMA user_version = 1");
    }
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
    REQUIRE(store->Load().has_value());
    CHECK(store->Load()->plans.size() == 1);
    CHECK(store->Load()->tscState == ETscState::Auto);
    CHECK(store->Append({{TscChanged{ETscState::Paused}}}).has_value());
    CHECK(store->Load()->tscState == ETscState::Paused);
}

TEST_CASE("Store: a batch that fails in the middle leaves nothing behind and the store goes on")
{
    const StoreFolder folder;
    const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
    REQUIRE(store->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    const Core::Result<void> twice = store->Append({{ReportAdded{MakeEntry(1, "P1")}, PlanAdded{MakeRecord(2, "P1")}}});
    REQUIRE_FALSE(twice.has_value());
    CHECK(twice.error().code == EPlanningError::StoreFailed);
    CHECK(store->Load()->outbox.empty());
    CHECK(store->Load()->plans.size() == 1);
    CHECK(store->Append({{PlanAdded{MakeRecord(2, "P2")}, ReportAdded{MakeEntry(1, "P2")}}}).has_value());
    CHECK(store->Load()->plans.size() == 2);
}

TEST_CASE("Store: damage, another program's file and a newer version are told apart and left as they are")
{
    const StoreFolder folder;
    const auto refuse = [&folder](EPlanningError error) {
        const std::uintmax_t size = std::filesystem::file_size(folder.GetFile());
        const Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open(folder.GetFile());
        REQUIRE_FALSE(store.has_value());
        CHECK(store.error().code == error);
        CHECK(Core::Describe(store.error()).find(folder.GetFile()) != std::string::npos);
        CHECK(std::filesystem::file_size(folder.GetFile()) == size);
    };
    SECTION("no database")
    {
        std::ofstream(folder.GetFile()) << std::string(8192, 'x');
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("a damaged page")
    {
        {
            const std::unique_ptr<SqlitePlanStore> store = OpenStore(folder.GetFile());
            for (std::uint64_t sequence = 1; sequence <= 100; ++sequence)
            {
                const PlanRecord record = MakeRecord(sequence, "P" + std::to_string(sequence));
                REQUIRE(store->Append({{PlanAdded{record}}}).has_value());
            }
        }
        std::fstream file(folder.GetFile(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(3 * 4096);
        file << std::string(4096, 'x');
        file.close();
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("another program's")
    {
        SQLite::Database(folder.GetFile(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE a (b)");
        refuse(EPlanningError::StoreCorrupt);
    }
    SECTION("a newer version")
    {
        static_cast<void>(OpenStore(folder.GetFile()));
        SQLite::Database(folder.GetFile(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
        refuse(EPlanningError::StoreTooNew);
    }
    SECTION("a row that cannot be read")
    {
        REQUIRE(OpenStore(folder.GetFile())->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
        SQLite::Database(folder.GetFile(), SQLite::OPEN_READWRITE).exec("UPDATE plans SET progress = '{}'");
        const Core::Result<StoredState> loaded = OpenStore(folder.GetFile())->Load();
        REQUIRE_FALSE(loaded.has_value());
        CHECK(loaded.error().code == EPlanningError::StoreCorrupt);
        CHECK(loaded.error().found.find("plan P1") != std::string::npos);
    }
}

TEST_CASE("Store: a file is one program's at a time, and free again when that one has closed it")
{
    const StoreFolder folder;
    {
        const std::unique_ptr<SqlitePlanStore> first = OpenStore(folder.GetFile());
        const Core::Result<std::unique_ptr<SqlitePlanStore>> second = SqlitePlanStore::Open(folder.GetFile());
        REQUIRE_FALSE(second.has_value());
        CHECK(second.error().code == EPlanningError::StoreFailed);
        CHECK(second.error().path == folder.GetFile());
        CHECK(Core::Describe(second.error()).find("another program") != std::string::npos);
        CHECK(first->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    }
    CHECK(OpenStore(folder.GetFile())->Load()->plans.size() == 1);
}

TEST_CASE("Store: a folder that is not there is a failure that names the file")
{
    const Core::Result<std::unique_ptr<SqlitePlanStore>> store = SqlitePlanStore::Open("/nonexistent/acsd.db");
    REQUIRE_FALSE(store.has_value());
    CHECK(store.error().code == EPlanningError::StoreFailed);
    CHECK(store.error().path == "/nonexistent/acsd.db");
}

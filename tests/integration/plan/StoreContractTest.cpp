#include "Catch.hpp"
#include "ManualClock.hpp"
#include "PostgresPlace.hpp"
#include "SqlitePlace.hpp"
#include "StoreSamples.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

// What every store does.

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

TEMPLATE_TEST_CASE(
    "Store: a store that is closed and opened again has the content of the store in memory",
    "",
    SqlitePlace,
    PostgresPlace)
{
    const TestType place;
    MemoryPlanStore memory;
    for (const StoreBatch& batch : MakeBatches())
    {
        REQUIRE(place.Open()->Append(batch).has_value());
        REQUIRE(memory.Append(batch).has_value());
    }
    const Core::Result<StoredState> loaded = place.Open()->Load();
    REQUIRE(loaded.has_value());
    CHECK(*loaded == memory.GetState());
    CHECK(loaded->lastReportSequence == 3);
    CHECK(loaded->plans.size() == 2);
    CHECK(loaded->tscState == ETscState::Pausing);
    CHECK(loaded->robotsInMaintenance == std::vector<std::string>{"CR01"});

    REQUIRE(place.Open()->Append({{AlarmCleared{GetAlarm()}}}).has_value());
    CHECK(place.Open()->Load()->alarms.empty());
}

TEMPLATE_TEST_CASE(
    "Store: a planID whose plan was removed can be stored again, also in the same batch",
    "",
    SqlitePlace,
    PostgresPlace)
{
    const TestType place;
    const std::unique_ptr<IPlanStore> store = place.Open();
    REQUIRE(store->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    REQUIRE(store->Append({{PlanRemoved{1}, PlanAdded{MakeRecord(2, "P1")}}}).has_value());
    REQUIRE(store->Load()->plans.size() == 1);
    CHECK(store->Load()->plans.front().sequence == 2);
}

TEMPLATE_TEST_CASE("Store: receipts are kept 10 minutes, at most 1,000 of them", "", SqlitePlace, PostgresPlace)
{
    const TestType place;
    const std::unique_ptr<IPlanStore> store = place.Open();
    MemoryPlanStore memory;
    const auto add = [&](const std::string& key, Core::WallTime time) {
        const StoreBatch batch{{ReceiptAdded{{"lee", key, "answer", time}}}};
        REQUIRE(store->Append(batch).has_value());
        REQUIRE(memory.Append(batch).has_value());
        REQUIRE(store->Load()->receipts == memory.GetState().receipts);
        return memory.GetState().receipts;
    };
    const Core::WallTime start = Testing::ManualClock().GetNow().wall;
    add("old", start);
    add("older", start + std::chrono::milliseconds(1));
    const std::vector<CommandReceipt> kept = add("new", start + CommandReceipt::KEPT);
    REQUIRE(kept.size() == 2);
    CHECK(kept.front().key == "older");
    StoreBatch many;
    for (std::size_t number = 0; number < CommandReceipt::MOST_RECEIPTS; ++number)
    {
        many.changes.emplace_back(ReceiptAdded{{"lee", std::to_string(number), {}, start}});
    }
    REQUIRE(store->Append(many).has_value());
    REQUIRE(memory.Append(many).has_value());
    CHECK(store->Load()->receipts.size() == CommandReceipt::MOST_RECEIPTS);
    CHECK(store->Load()->receipts.front().key == "0");
    CHECK(store->Load()->receipts == memory.GetState().receipts);
}

TEMPLATE_TEST_CASE(
    "Store: a batch that fails in the middle leaves no change, and the store still works",
    "",
    SqlitePlace,
    PostgresPlace)
{
    const TestType place;
    const std::unique_ptr<IPlanStore> store = place.Open();
    REQUIRE(store->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    const Core::Result<void> twice = store->Append({{ReportAdded{MakeEntry(1, "P1")}, PlanAdded{MakeRecord(2, "P1")}}});
    REQUIRE_FALSE(twice.has_value());
    CHECK(twice.error().code == EPlanningError::StoreFailed);
    CHECK(store->Load()->outbox.empty());
    CHECK(store->Load()->plans.size() == 1);
    CHECK(store->Append({{PlanAdded{MakeRecord(2, "P2")}, ReportAdded{MakeEntry(1, "P2")}}}).has_value());
    CHECK(store->Load()->plans.size() == 2);
}

TEMPLATE_TEST_CASE("Store: a row that cannot be read is named", "", SqlitePlace, PostgresPlace)
{
    const TestType place;
    REQUIRE(place.Open()->Append({{PlanAdded{MakeRecord(1, "P1")}}}).has_value());
    const auto refuse = [&place](const std::string& sql, const std::string& found) {
        place.Execute(sql);
        const Core::Result<StoredState> loaded = place.Open()->Load();
        REQUIRE_FALSE(loaded.has_value());
        CHECK(loaded.error().code == EPlanningError::StoreCorrupt);
        CHECK(loaded.error().expected.find("restore a backup") != std::string::npos);
        CHECK(loaded.error().found.find(found) != std::string::npos);
    };
    SECTION("a plan without progress")
    {
        refuse("UPDATE plans SET progress = '{}'", "plan P1");
    }
    SECTION("a state of the TSC that does not exist")
    {
        refuse("INSERT INTO settings (name, value) VALUES ('tsc_state', 'Odd')", "state of the TSC: Odd");
    }
    SECTION("a report that is no JSON")
    {
        refuse("INSERT INTO reports (sequence, transaction_id, time, report) VALUES (9, 'T', 0, 'x')", "report 9");
    }
}

TEMPLATE_TEST_CASE(
    "Store: identifiers are sorted as bytes and may have any printable character",
    "",
    SqlitePlace,
    PostgresPlace)
{
    const TestType place;
    const std::unique_ptr<IPlanStore> store = place.Open();
    const std::vector<std::string> sorted{"B", "a'; DROP TABLE plans; --", "b", "\xC3\xA9", "\xEA\xB0\x80"};
    const std::vector<std::string> reversed(sorted.rbegin(), sorted.rend());
    for (const std::string& id : reversed)
    {
        REQUIRE(store->Append({{MaintenanceChanged{id, true}}}).has_value());
    }
    CHECK(store->Load()->robotsInMaintenance == sorted);
    CHECK(store->Check().has_value());
    CHECK(store->CheckLog().blockReason.empty());
}

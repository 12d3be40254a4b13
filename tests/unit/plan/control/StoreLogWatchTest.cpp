#include "control/StoreLogWatch.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

constexpr std::uint64_t MEBIBYTE = 1024U * 1024U;
constexpr const char* REASON = "another program reads the database";

std::vector<std::string> ListSet(EngineParts& parts, const StoreLog& log)
{
    StoreLogWatch(parts.engine).OnStoreLog(log);
    return parts.Collect().ListSetAlarms();
}

} // namespace

TEST_CASE("StoreLogWatch: a log that cannot be merged raises a light alarm beyond the limit, until it was merged")
{
    EngineParts parts;
    const StoreLog atLimit{"acsd.db", 64 * MEBIBYTE, 1'000 * MEBIBYTE, REASON};
    CHECK(ListSet(parts, atLimit).empty());
    StoreLog beyond = atLimit;
    ++beyond.bytes;
    StoreLogWatch(parts.engine).OnStoreLog(beyond);
    const auto set = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(set.size() == 1);
    CHECK(set.front().alarm.robotID == "ACS");
    CHECK(set.front().alarm.errorCode == "ACS-1021");
    CHECK(set.front().alarm.level == EAlarmLevel::Light);
    CHECK(
        set.front().alarm.message
        == "The log of the store acsd.db has 64 MiB and cannot be merged into the database, with 1000 MiB free on its file "
           "system: another program reads the database");

    StoreLogWatch(parts.engine).OnStoreLog(atLimit); // not merged yet
    StoreLogWatch(parts.engine).OnStoreLog(beyond);
    CHECK(parts.Collect().ListChanges<AlarmSet>().empty());
    beyond.blockReason.clear();
    StoreLogWatch(parts.engine).OnStoreLog(beyond);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1021"});
    CHECK(parts.engine.alarms.GetAlarms().empty());
}

TEST_CASE(
    "StoreLogWatch: with less free space than the limit the alarm comes earlier, but only for a log that cannot be merged")
{
    EngineParts parts;
    CHECK(ListSet(parts, {"acsd.db", 4 * MEBIBYTE, 0, {}}).empty());
    CHECK(ListSet(parts, {"acsd.db", 9 * MEBIBYTE, 64 * MEBIBYTE, REASON}).empty());
    CHECK(ListSet(parts, {"acsd.db", 9 * MEBIBYTE, 64 * MEBIBYTE - 1, REASON}) == std::vector<std::string>{"ACS-1021"});
}

TEST_CASE("An alarm about the log of the store is reported, survives a restart, and is cleared by the next check")
{
    PlanWorld world;
    world.Connect();
    const auto check = [&world](const StoreLog& log) {
        EngineActions actions;
        world.engine->OnStoreLog(log, world.GetNow(), actions);
        for (const EngineAction& action : actions)
        {
            if (const auto* const storeOrNull = std::get_if<StorePlans>(&action); storeOrNull != nullptr)
            {
                REQUIRE(world.store.Append(storeOrNull->batch).has_value());
                EngineActions released;
                world.engine->OnStored({}, world.GetNow(), released);
                CHECK(std::ranges::any_of(released, [](const EngineAction& one) {
                    return std::holds_alternative<SendReport>(one);
                }));
            }
        }
    };
    check({"acsd.db", 65 * MEBIBYTE, 0, REASON});
    REQUIRE(world.store.GetState().alarms.size() == 1);
    world.Restart(MakeTestOptions(false), MakeTestSite());
    REQUIRE(world.engine->GetActiveAlarms().size() == 1);
    CHECK(world.engine->GetActiveAlarms().front().errorCode == "ACS-1021");
    check({"acsd.db", 4096, 0, {}});
    CHECK(world.engine->GetActiveAlarms().empty());
    CHECK(world.store.GetState().alarms.empty());
}

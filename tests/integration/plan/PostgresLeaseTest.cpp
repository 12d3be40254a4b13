#include "PostgresPlace.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

LeaseClaim MakeClaim(const std::string& holder)
{
    return {holder, "config", std::chrono::seconds(3)};
}

} // namespace

TEST_CASE("Lease: it is taken as it was seen, or not at all")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresLease> first = place.OpenLease();
    const std::unique_ptr<PostgresLease> second = place.OpenLease();
    const LeaseState free = *first->Read();
    CHECK(free == LeaseState{});
    REQUIRE(**first->TryTakeOrNull(free, MakeClaim("first")) == 1);
    CHECK_FALSE(second->TryTakeOrNull(free, MakeClaim("second"))->has_value());
    const LeaseState seen = *second->Read();
    CHECK(seen == LeaseState{1, 0, "first", "config", std::chrono::seconds(3), false});
    CHECK(*first->TryRenew(1));
    CHECK(second->Read()->renewal == 1);
    CHECK_FALSE(second->TryTakeOrNull(seen, MakeClaim("second"))->has_value());
    CHECK(**second->TryTakeOrNull(*second->Read(), MakeClaim("second")) == 2);
    CHECK_FALSE(*first->TryRenew(1));
    CHECK(first->Release(1).has_value()); // of a lease that it has lost: nothing
    CHECK_FALSE(second->Read()->bReleased);
    CHECK(second->Release(2).has_value());
    CHECK(first->Read()->bReleased);
    CHECK_FALSE(*second->TryRenew(2));
    CHECK(**first->TryTakeOrNull(*first->Read(), MakeClaim("first")) == 3);
}

TEST_CASE("Lease: a store that is taken waits for a transaction of the former leader, and stores none later")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
    REQUIRE(store->Append({{MaintenanceChanged{"LR01", true}}}).has_value());
    // A process that has stalled in a transaction: the server ends its session.
    place.Execute("CREATE TABLE now AS SELECT epoch, session FROM batches");
    const std::unique_ptr<PostgresLease> lease = place.OpenLease();
    const std::string stalled = GetServer().GetURL(place.GetDatabase());
    Testing::ChildProcess client(
        {"psql",
         "-X",
         "-q",
         "-v",
         "ON_ERROR_STOP=1",
         stalled,
         "-c",
         "SET idle_in_transaction_session_timeout TO 300",
         "-c",
         "BEGIN",
         "-c",
         "SELECT acsd.begin_batch(epoch, session, 0) FROM acsd.now",
         "-c",
         R"(\echo stalled)",
         "-c",
         R"(\! sleep 2)",
         "-c",
         "COMMIT"});
    REQUIRE(client.TryWaitForText("stalled", std::chrono::seconds(10)));
    const auto taken = lease->TryTakeOrNull(*lease->Read(), MakeClaim("successor"));
    REQUIRE(taken.has_value());
    CHECK(taken->has_value());
    CHECK(client.WaitForExitOrNull(std::chrono::seconds(10)) != 0);
    CHECK(place.Execute("SELECT number FROM batches") == "1\n");
}

TEST_CASE("Lease: rows that acsd has not written are reported, and nothing is taken")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresLease> lease = place.OpenLease();
    REQUIRE(lease->TryTakeOrNull(*lease->Read(), MakeClaim("leader"))->has_value());
    const LeaseState seen = *lease->Read();
    const std::string change = GENERATE(
        as<std::string>{},
        "DELETE FROM lease",
        "DELETE FROM batches",
        "UPDATE lease SET duration_ms = 0",
        "UPDATE lease SET duration_ms = 9000000000000000000",
        "UPDATE lease SET epoch = -1",
        "UPDATE lease SET epoch = 9223372036854775807",
        "ALTER TABLE lease ALTER epoch DROP NOT NULL; UPDATE lease SET epoch = NULL",
        "UPDATE lease SET renewal = -1");
    INFO(change);
    place.Execute(change);
    const Core::Result<LeaseState> state = lease->Read();
    REQUIRE_FALSE(state.has_value());
    CHECK(state.error().code == EPlanningError::StoreCorrupt);
    CHECK_THAT(Core::Describe(state.error()), Catch::Contains("stop all processes, then restore a backup"));
    if (change == "DELETE FROM batches")
    {
        CHECK_FALSE(lease->TryTakeOrNull(seen, MakeClaim("standby"))->has_value());
        CHECK(place.Execute("SELECT epoch, holder FROM lease") == "1|leader\n");
    }
}

TEST_CASE("Lease: an epoch is never used again, also if the row was changed by hand")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresLease> lease = place.OpenLease();
    REQUIRE(lease->TryTakeOrNull(*lease->Read(), MakeClaim("leader"))->has_value());
    REQUIRE(**lease->TryTakeOrNull(*lease->Read(), MakeClaim("leader")) == 2);
    place.Execute("UPDATE lease SET epoch = 0");
    CHECK_FALSE(*lease->TryRenew(2));
    CHECK(**lease->TryTakeOrNull(*lease->Read(), MakeClaim("standby")) == 3);
}

TEST_CASE("Lease: tables that are missing later are not created again")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresLease> lease = place.OpenLease();
    place.Execute("DROP SCHEMA acsd CASCADE");
    GetServer().Execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'acsd'");
    CHECK_FALSE(lease->Read().has_value()); // the connection was lost
    const Core::Result<LeaseState> state = lease->Read();
    REQUIRE_FALSE(state.has_value());
    CHECK_THAT(Core::Describe(state.error()), Catch::Contains("the tables that this process has used"));

    PostgresOptions options = place.GetOptions();
    options.bMayCreate = false;
    CHECK_FALSE(PostgresLease(options).Read().has_value());
    CHECK(place.OpenLease()->Read().has_value()); // a process that starts
    CHECK(PostgresLease(options).Read().has_value());
}

TEST_CASE("Lease: several processes create the tables of an empty database at the same time")
{
    const PostgresPlace place;
    std::vector<std::thread> threads;
    std::vector<std::string> errors(4);
    threads.reserve(errors.size());
    for (std::string& error : errors)
    {
        threads.emplace_back([&place, &error] {
            const Core::Result<LeaseState> state = PostgresLease(place.GetOptions()).Read();
            error = state.has_value() ? std::string() : Core::Describe(state.error());
        });
    }
    for (std::thread& thread : threads)
    {
        thread.join();
    }
    CHECK(errors == std::vector<std::string>(4));
}

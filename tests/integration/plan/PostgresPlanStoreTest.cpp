#include "CuttingProxy.hpp"
#include "PostgresPlace.hpp"
#include "StoreSamples.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

using namespace ACS::Planning;       // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Planning::Test; // NOLINT(google-build-using-namespace)
using namespace ACS;                 // NOLINT(google-build-using-namespace)

namespace
{

StoreBatch MakePlan(std::uint64_t number)
{
    return {{PlanAdded{MakeRecord(number, "P" + std::to_string(number))}, ReportAdded{MakeEntry(number, "P1")}}};
}

std::size_t CountPlans(const PostgresPlace& place)
{
    return std::stoul(place.Execute("SELECT count(*) FROM plans"));
}

} // namespace

TEST_CASE("PostgreSQL: nothing is stored with an epoch that is not the present one")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> former = place.OpenWith(place.GetOptions());
    REQUIRE(former->Append(MakePlan(1)).has_value());
    const std::unique_ptr<PostgresPlanStore> present = place.OpenWith(place.GetOptions());
    const Core::Result<void> refused = former->Append(MakePlan(2));
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == EPlanningError::StoreTaken);
    CHECK(former->Check().error().code == EPlanningError::StoreTaken);
    CHECK(present->Append(MakePlan(3)).has_value());
    CHECK(present->Check().has_value());
    CHECK(CountPlans(place) == 2);
    CHECK(former->Append({}).error().code == EPlanningError::StoreTaken);
}

TEST_CASE("PostgreSQL: a connection that is lost during a commit leaves no doubt about its outcome")
{
    const PostgresPlace place;
    CuttingProxy proxy(GetServer().GetPort());
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions(proxy.GetPort()));
    REQUIRE(store->Append(MakePlan(1)).has_value());
    SECTION("it was stored")
    {
        proxy.Cut(ECut::AfterCommit);
        CHECK(store->Append(MakePlan(2)).has_value());
        CHECK(CountPlans(place) == 2);
    }
    SECTION("it was not stored")
    {
        proxy.Cut(ECut::BeforeCommit);
        const Core::Result<void> failed = store->Append(MakePlan(2));
        REQUIRE_FALSE(failed.has_value());
        CHECK(failed.error().code == EPlanningError::StoreFailed);
        CHECK(CountPlans(place) == 1);
        CHECK(store->Append(MakePlan(2)).has_value());
    }
    SECTION("another process has taken the lease meanwhile")
    {
        proxy.Cut(ECut::AfterCommit);
        place.Execute(
            "CREATE FUNCTION take() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN UPDATE acsd.batches SET epoch = epoch + 1; "
            "RETURN NULL; END $$; "
            "CREATE CONSTRAINT TRIGGER take AFTER INSERT ON plans DEFERRABLE INITIALLY DEFERRED FOR EACH ROW EXECUTE FUNCTION take()");
        CHECK(store->Append(MakePlan(2)).error().code == EPlanningError::StoreTaken);
        proxy.Cut(ECut::Nothing);
        return;
    }
    CHECK(proxy.GetCuts() == 1);
    CHECK(store->Append(MakePlan(3)).has_value());
    CHECK(CountPlans(place) == 3);
    CHECK(store->Load()->lastReportSequence == 3);
}

TEST_CASE("PostgreSQL: a transaction of a former connection that arrives late is not stored")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
    REQUIRE(store->Append(MakePlan(1)).has_value());
    place.Execute("CREATE TABLE late AS SELECT epoch, session FROM batches");
    place.Execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'acsd'");
    CHECK_FALSE(store->Append(MakePlan(2)).has_value());
    REQUIRE(store->Append(MakePlan(2)).has_value());
    CHECK_THROWS_WITH(
        place.Execute("SELECT begin_batch(epoch, session, 0) FROM late"),
        Catch::Contains("another process leads, or this one has connected again"));
    CHECK(CountPlans(place) == 2);
}

TEST_CASE("PostgreSQL: a server that ends and starts again loses nothing")
{
    Testing::PostgresServer server;
    const PostgresOptions options{server.GetURL(), {}, std::chrono::seconds(5)};
    PostgresLease lease(options);
    const auto epoch = lease.TryTakeOrNull(*lease.Read(), {"a test", "", std::chrono::seconds(3)});
    REQUIRE(epoch.has_value());
    const auto store = PostgresPlanStore::Open(options, **epoch);
    REQUIRE(store.has_value());
    REQUIRE((*store)->Append(MakePlan(1)).has_value());
    server.Kill();
    const Core::Result<void> failed = (*store)->Check();
    REQUIRE_FALSE(failed.has_value());
    CHECK(failed.error().code == EPlanningError::StoreFailed);
    CHECK_FALSE(lease.TryRenew(**epoch).has_value());
    server.Start();
    CHECK((*store)->Append(MakePlan(2)).has_value());
    CHECK(lease.TryRenew(**epoch).value_or(false));
    CHECK((*store)->Load()->plans.size() == 2);
}

TEST_CASE("PostgreSQL: a server that does not answer is an error after the timeout")
{
    const PostgresPlace place;
    CuttingProxy proxy(GetServer().GetPort());
    PostgresOptions options = place.GetOptions(proxy.GetPort());
    options.timeout = std::chrono::milliseconds(200);
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(options);
    SECTION("a lock of another program")
    {
        place.Execute(
            "CREATE FUNCTION hold() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM pg_sleep(60); RETURN NEW; END $$; "
            "CREATE TRIGGER hold BEFORE INSERT ON plans FOR EACH ROW EXECUTE FUNCTION hold()");
        const Core::Result<void> failed = store->Append(MakePlan(1));
        REQUIRE_FALSE(failed.has_value());
        place.Execute("DROP TRIGGER hold ON plans");
        CHECK(store->Append(MakePlan(1)).has_value());
    }
    SECTION("a network that is silent")
    {
        proxy.Cut(ECut::Silence);
        const Core::Result<void> failed = store->Append(MakePlan(1));
        REQUIRE_FALSE(failed.has_value());
        CHECK(failed.error().code == EPlanningError::StoreTaken); // it may have been stored
        CHECK(failed.error().found.find("no answer for 0.2 s") != std::string::npos);
    }
}

TEST_CASE("PostgreSQL: a transaction that the server ends because of another one is repeated")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
    place.Execute(
        "CREATE SEQUENCE attempts; CREATE FUNCTION fail() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        "IF nextval('acsd.attempts') <= 2 THEN RAISE EXCEPTION 'could not serialize access' USING ERRCODE = '40001'; END IF; "
        "RETURN NEW; END $$; CREATE TRIGGER fail BEFORE INSERT ON plans FOR EACH ROW EXECUTE FUNCTION fail()");
    CHECK(store->Append(MakePlan(1)).has_value());
    CHECK(CountPlans(place) == 1);
    CHECK(place.Execute("SELECT last_value FROM attempts") == "3\n");
}

TEST_CASE("PostgreSQL: what is found before the start has a state and a sentence")
{
    const PostgresPlace place;
    const auto refuse = [&place](EPlanningError error, const std::string& part) {
        const Core::Result<StoreOrigin> origin = PostgresPlanStore::Inspect(place.GetOptions());
        REQUIRE_FALSE(origin.has_value());
        CHECK(origin.error().code == error);
        CHECK_THAT(Core::Describe(origin.error()), Catch::Contains(part));
    };
    SECTION("an empty database")
    {
        const Core::Result<StoreOrigin> origin = PostgresPlanStore::Inspect(place.GetOptions());
        REQUIRE(origin.has_value());
        CHECK(origin->bNew);
        CHECK(*PostgresPlanStore::InspectState(place.GetOptions()) == StoredState{});
        CHECK(GetServer().Execute("SELECT count(*) FROM pg_namespace WHERE nspname = 'acsd'") == "0\n");
    }
    SECTION("a store in use")
    {
        const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
        REQUIRE(store->Append(MakePlan(1)).has_value());
        CHECK_FALSE(PostgresPlanStore::Inspect(place.GetOptions())->bNew);
        CHECK(PostgresPlanStore::InspectState(place.GetOptions())->plans.size() == 1);
        CHECK(store->Append(MakePlan(2)).has_value());
    }
    SECTION("a newer version")
    {
        static_cast<void>(place.OpenLease());
        place.Execute("UPDATE settings SET value = '99' WHERE name = 'schema_version'");
        refuse(EPlanningError::StoreTooNew, "version 99");
        CHECK_FALSE(PostgresLease(place.GetOptions()).Read().has_value());
    }
    SECTION("the schema of another program")
    {
        place.Execute("CREATE SCHEMA acsd; CREATE TABLE acsd.things (a int)");
        refuse(EPlanningError::StoreCorrupt, "another program");
    }
}

TEST_CASE("PostgreSQL: the character that it cannot store is replaced")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
    const Alarm alarm{"LR01", std::string("AGV-\0\0x", 7), EAlarmLevel::Light, std::string("a\0b", 3), {}, {}, {}};
    REQUIRE(store->Append({{AlarmSet{alarm}}}).has_value());
    CHECK(store->Load()->alarms == std::vector<Alarm>{alarm}); // its JSON text has all characters
    REQUIRE(store->Append({{AlarmCleared{alarm}}}).has_value());
    CHECK(store->Load()->alarms.empty());
    CHECK_FALSE(store->Append({{MaintenanceChanged{"LR\xff", true}}}).has_value());
    CHECK(store->Append({{MaintenanceChanged{"LR01", true}}}).has_value());
}

TEST_CASE("PostgreSQL: a session that the server ends just after a commit has stored it")
{
    const PostgresPlace place;
    const std::unique_ptr<PostgresPlanStore> store = place.OpenWith(place.GetOptions());
    REQUIRE(store->Append(MakePlan(1)).has_value());
    place.Execute(
        "CREATE FUNCTION fall() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM pg_terminate_backend(pg_backend_pid()); "
        "RETURN NULL; END $$; CREATE CONSTRAINT TRIGGER fall AFTER INSERT ON plans DEFERRABLE INITIALLY DEFERRED "
        "FOR EACH ROW EXECUTE FUNCTION fall()");
    const Core::Result<void> result = store->Append(MakePlan(2));
    CHECK(CountPlans(place) == (result.has_value() ? 2U : 1U)); // the answer is true, whenever the session ended
    place.Execute("DROP TRIGGER fall ON plans");
    CHECK(store->Append(MakePlan(3)).has_value());
}

TEST_CASE("PostgreSQL: a silent host does not keep the next one from being tried")
{
    const PostgresPlace place;
    CuttingProxy silent(GetServer().GetPort());
    silent.Cut(ECut::Silence);
    const PostgresOptions options{
        "postgresql://acsd@127.0.0.1:" + std::to_string(silent.GetPort())
            + ",127.0.0.1:" + std::to_string(GetServer().GetPort()) + "/" + place.GetDatabase(),
        {},
        std::chrono::seconds(2)};
    CHECK(PostgresLease(options).Read().has_value());
}

TEST_CASE("PostgreSQL: a call that waits for the server ends when it should stop")
{
    const PostgresPlace place;
    CuttingProxy silent(GetServer().GetPort());
    silent.Cut(ECut::Silence);
    PostgresOptions options = place.GetOptions(silent.GetPort());
    options.timeout = std::chrono::hours(1);
    int questions = 0;
    options.shouldStop = [&questions] {
        return ++questions > 3;
    };
    CHECK_FALSE(PostgresLease(options).Read().has_value());
}

#include "robots/VehicleJob.hpp"

#include "Catch.hpp"
#include "robots/VehicleFixture.hpp"

#include <optional>

namespace ACS::Acsd::Test
{

TEST_CASE("A deferred job is returned once, and is not running")
{
    VehicleJob job;
    CHECK_FALSE(job.TakeDeferredOrNull().has_value());
    job.Defer(MakeJob("CassetteLoad"));
    CHECK(job.IsDeferred("J"));
    CHECK_FALSE(job.IsDeferred("K"));
    CHECK(job.GetRunningOrNull() == nullptr);
    const std::optional<VehicleJob::Deferred> deferred = job.TakeDeferredOrNull();
    REQUIRE(deferred.has_value());
    CHECK(deferred->job.commandID == "U1");
    CHECK_FALSE(deferred->bOutdated);
    CHECK_FALSE(job.IsDeferred("J"));
    CHECK_FALSE(job.TakeDeferredOrNull().has_value());
}

TEST_CASE("A job to be recovered replaces a deferred one")
{
    VehicleJob job;
    job.Defer(MakeJob("CassetteLoad"));
    job.Recover({MakeJob("CassetteLoad"), {"D"}});
    CHECK_FALSE(job.IsDeferred("J"));
    CHECK(job.IsRecovering());
    const std::optional<Planning::RecoverJob> recovery = job.TakeRecoveryOrNull();
    REQUIRE(recovery.has_value());
    CHECK(recovery->earlierIDs == std::vector<std::string>{"D"});
    CHECK_FALSE(job.IsRecovering());
}

TEST_CASE("A running job starts once, and each job by itself")
{
    VehicleJob job;
    CHECK_FALSE(job.TryStart());
    job.Run(MakeJob("CassetteLoad"));
    REQUIRE(job.GetRunningOrNull() != nullptr);
    CHECK(job.TryStart());
    CHECK_FALSE(job.TryStart());
    CHECK(job.TakeRunning().jobID == "J");
    CHECK(job.GetRunningOrNull() == nullptr);
    job.Run(MakeJob("CassetteLoad"));
    CHECK(job.TryStart());
}

TEST_CASE("A job whose loads are verified is not running, and no other job keeps its check")
{
    VehicleJob job;
    job.Run(MakeJob("CassetteLoad"));
    job.VerifyLoads(LoadCheck(job.TakeRunning(), Planning::EActionEffect::Load));
    CHECK(job.GetRunningOrNull() == nullptr);
    REQUIRE(job.GetLoadCheckOrNull() != nullptr);
    CHECK(job.GetLoadCheckOrNull()->GetJobID() == "J");
    job.Run(MakeJob("CassetteLoad"));
    CHECK(job.GetLoadCheckOrNull() == nullptr);
}

} // namespace ACS::Acsd::Test

#include "robot/JobTracker.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

StartJob MakeJob(const std::string& jobID, const std::string& progressToken = {})
{
    StartJob job;
    job.planID = "P1";
    job.jobID = jobID;
    job.progressToken = progressToken;
    return job;
}

JobTracker MakeTracker(const std::string& progressToken = {})
{
    JobTracker tracker;
    tracker.Begin(MakeJob("J1", progressToken));
    return tracker;
}

/// The ID of the resolved job; empty: none.
std::string GetResolvedID(const JobTracker& tracker)
{
    const StartJob* const jobOrNull = tracker.GetResolvedOrNull();
    return jobOrNull == nullptr ? std::string() : jobOrNull->jobID;
}

} // namespace

TEST_CASE("JobTracker: a job is open from its command to its release")
{
    CHECK(JobTracker().GetOrNull() == nullptr);
    JobTracker tracker = MakeTracker();
    REQUIRE(tracker.GetOrNull() != nullptr);
    CHECK(tracker.GetOrNull()->jobID == "J1");
    CHECK_FALSE(tracker.IsRecovering());
    CHECK_FALSE(tracker.IsUnresolved());
    tracker.Release();
    CHECK(tracker.GetOrNull() == nullptr);
}

TEST_CASE("JobTracker: after a restart the outcome is requested once")
{
    JobTracker tracker = MakeTracker();
    CHECK_FALSE(tracker.TryEndRecovery());
    tracker.BeginRecovery();
    CHECK(tracker.IsRecovering());
    CHECK(tracker.TryEndRecovery());
    CHECK_FALSE(tracker.TryEndRecovery());
}

TEST_CASE("JobTracker: an unresolved job waits for an operator")
{
    JobTracker tracker = MakeTracker();
    tracker.BeginRecovery();
    tracker.MarkUnresolved();
    CHECK(tracker.IsUnresolved());
    CHECK_FALSE(tracker.IsRecovering());
    CHECK_FALSE(tracker.TryEndRecovery());

    SECTION("whose decision leaves it open until it is released")
    {
        tracker.Resolve();
        CHECK_FALSE(tracker.IsUnresolved());
        CHECK(tracker.GetOrNull() != nullptr);
    }
    SECTION("and the next job does not")
    {
        tracker.Begin({});
        CHECK_FALSE(tracker.IsUnresolved());
    }
}

TEST_CASE("JobTracker: a decision about a job that is being recovered keeps it so")
{
    JobTracker tracker = MakeTracker();
    tracker.BeginRecovery();
    tracker.Resolve();
    CHECK(tracker.IsRecovering());
}

TEST_CASE("JobTracker: a job that the robot must not continue is to be cancelled when the robot is back")
{
    JobTracker tracker = MakeTracker();
    CHECK_FALSE(tracker.TakeCancelOrNull().has_value());
    SECTION("each time while it is open")
    {
        tracker.MarkOverdue();
        CHECK(tracker.TakeCancelOrNull() == "J1");
        CHECK(tracker.TakeCancelOrNull() == "J1");
        tracker.Release();
    }
    SECTION("once after an operator has abandoned it")
    {
        tracker.Abandon();
        tracker.Release();
        CHECK(tracker.GetAbandonedID() == "J1");
        CHECK(tracker.TakeCancelOrNull() == "J1");
    }
    SECTION("not after the next command")
    {
        tracker.Abandon();
        tracker.Release();
        tracker.Begin(StartJob{});
    }
    SECTION("once after a restart")
    {
        tracker = JobTracker();
        tracker.RestoreAbandoned("J1");
        CHECK(tracker.TakeCancelOrNull() == "J1");
    }
    CHECK_FALSE(tracker.TakeCancelOrNull().has_value());
}

TEST_CASE("JobTracker: an overdue job is known by its id until it is released")
{
    JobTracker tracker = MakeTracker();
    CHECK_FALSE(tracker.IsOverdue("J1"));
    tracker.MarkOverdue();
    CHECK(tracker.IsOverdue());
    CHECK(tracker.IsOverdue("J1"));
    CHECK_FALSE(tracker.IsOverdue("J2"));
    tracker.MarkUnresolved();
    CHECK(tracker.IsOverdue());
    tracker.Release();
    CHECK_FALSE(tracker.IsOverdue());
    CHECK_FALSE(tracker.IsOverdue("J1"));
}

TEST_CASE("JobTracker: a job of an arm that an operator has decided is resolved until the robot no longer has it")
{
    JobTracker tracker = MakeTracker("5 5 0");
    const bool bFailed = GENERATE(false, true);
    bFailed ? tracker.Abandon() : tracker.Resolve();
    tracker.Release();
    CHECK(GetResolvedID(tracker) == "J1");
    CHECK_FALSE(tracker.IsResolvedRecoveryDue()); // there was no restart
    CHECK_FALSE(tracker.IsResolvedRecovering("J1"));
    tracker.Begin(MakeJob("J2", "6 5 0"));
    CHECK(GetResolvedID(tracker) == "J1");
    SECTION("its end was reported")
    {
        CHECK_FALSE(tracker.TryEndResolved("J2"));
        CHECK_FALSE(tracker.TryEndResolved("J3"));
        CHECK(GetResolvedID(tracker) == "J1");
        CHECK(tracker.TryEndResolved("J1"));
        CHECK_FALSE(tracker.TryEndResolved("J1"));
    }
    SECTION("the next job has begun")
    {
        tracker.MarkBegun("J3");
        CHECK(GetResolvedID(tracker) == "J1");
        tracker.MarkBegun("J2");
    }
    CHECK(GetResolvedID(tracker).empty());
}

TEST_CASE("JobTracker: a decision does not prove that the next job has begun; the arm may still have the first one")
{
    JobTracker tracker = MakeTracker("5 5 0");
    tracker.Resolve();
    tracker.Release();
    tracker.Begin(MakeJob("J2", "6 5 0"));
    tracker.Resolve();
    tracker.MarkBegun("J2");
    tracker.Release();
    CHECK(GetResolvedID(tracker) == "J1");
}

TEST_CASE("JobTracker: a job is not resolved without a decision, without a token, or after the robot reported its end")
{
    const bool bToken = GENERATE(false, true);
    JobTracker tracker = MakeTracker(bToken ? "5 5 0" : "");
    if (bToken && GENERATE(false, true))
    {
        CHECK_FALSE(tracker.TryEndResolved("J1"));
        tracker.MarkUnresolved();
        tracker.Resolve();
    }
    else if (!bToken)
    {
        tracker.Abandon();
    }
    tracker.Release();
    CHECK(GetResolvedID(tracker).empty());
}

TEST_CASE("JobTracker: after a restart a resolved job is asked for once, when the robot has no other one to report")
{
    JobTracker tracker = MakeTracker("6 5 0");
    tracker.RestoreResolved(MakeJob("J0", "5 5 0"));
    CHECK_FALSE(tracker.IsResolvedRecoveryDue());
    const bool bReleased = GENERATE(false, true);
    if (bReleased)
    {
        tracker.Release();
    }
    else
    {
        CHECK_FALSE(tracker.TryEndResolved("J1"));
    }
    CHECK(tracker.IsResolvedRecoveryDue());
    CHECK_FALSE(tracker.IsResolvedRecovering("J0"));
    tracker.BeginResolvedRecovery();
    CHECK_FALSE(tracker.IsResolvedRecoveryDue());
    CHECK(tracker.IsResolvedRecovering("J0"));
    CHECK_FALSE(tracker.IsResolvedRecovering("J1"));
    tracker.Begin(MakeJob("J0", "6 5 0")); // what is reported of J0 concerns this command
    CHECK_FALSE(tracker.IsResolvedRecovering("J0"));
    CHECK_FALSE(tracker.TryEndResolved("J0"));
    CHECK(GetResolvedID(tracker) == "J0");
}

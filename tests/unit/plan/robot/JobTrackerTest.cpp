#include "robot/JobTracker.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

JobTracker MakeTracker()
{
    StartJob job;
    job.planID = "P1";
    job.jobID = "J1";
    JobTracker tracker;
    tracker.Begin(job);
    return tracker;
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

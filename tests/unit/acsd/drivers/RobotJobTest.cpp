#include "Catch.hpp"
#include <acs/acsd/RobotJob.hpp>

namespace ACS::Acsd::Test
{

namespace
{

using Planning::AdapterActions;
using Planning::RaiseEvent;

/// Job J, commanded as C.
Planning::StartJob MakeCommandedJob()
{
    Planning::StartJob job;
    job.jobID = "J";
    job.commandID = "C";
    return job;
}

} // namespace

TEST_CASE("A job ends with the robot's answer about its commandID, once")
{
    RobotJob job;
    AdapterActions out;
    CHECK(job.GetJobOrNull() == nullptr);
    job.OnDone("C", out);
    job.Handle(Planning::Pause{});
    CHECK(out.empty());

    job.Handle(MakeCommandedJob());
    REQUIRE(job.GetJobOrNull() != nullptr);
    CHECK(*job.GetJobOrNull() == MakeCommandedJob());
    job.OnRunning("another", out);
    job.OnDone("another", out);
    job.OnFailed("another", "", out);
    job.OnRejected("another", "", out);
    job.OnNotExecuted("another", "", out);
    CHECK(out.empty());
    CHECK(job.GetJobOrNull() != nullptr);

    SECTION("done")
    {
        job.OnRunning("C", out);
        CHECK(job.GetJobOrNull() != nullptr);
        job.OnDone("C", out);
        CHECK(out == AdapterActions{RaiseEvent{Planning::JobStarted{"J"}}, RaiseEvent{Planning::JobFinished{"J"}}});
    }
    SECTION("failed")
    {
        job.OnFailed("C", "the gripper is jammed", out);
        CHECK(out == AdapterActions{RaiseEvent{Planning::JobFailed{"J", "the gripper is jammed"}}});
    }
    SECTION("rejected")
    {
        job.OnRejected("C", "busy", out);
        CHECK(out == AdapterActions{RaiseEvent{Planning::JobRejected{"J", "busy"}}});
    }
    CHECK(job.GetJobOrNull() == nullptr);
    out.clear();
    job.OnDone("C", out);
    CHECK(out.empty());
}

TEST_CASE("A job that was not executed is unknown, or interrupted if the robot had begun it")
{
    RobotJob job;
    AdapterActions out;
    job.Handle(MakeCommandedJob());
    job.OnNotExecuted("C", "restarted", out);
    CHECK(out == AdapterActions{RaiseEvent{Planning::JobUnknown{"J"}}});
    CHECK(job.GetJobOrNull() == nullptr);

    out.clear();
    job.Handle(MakeCommandedJob());
    job.OnRunning("C", out);
    job.OnNotExecuted("C", "restarted", out);
    CHECK(
        out
        == AdapterActions{
            RaiseEvent{Planning::JobStarted{"J"}},
            RaiseEvent{Planning::JobInterrupted{"J", "restarted"}}});

    out.clear();
    job.Handle(MakeCommandedJob());
    job.OnNotExecuted("C", "restarted", out);
    CHECK(out == AdapterActions{RaiseEvent{Planning::JobUnknown{"J"}}}); // that of before was another execution
}

TEST_CASE("A job from before a restart of acsd is kept until the robot has answered")
{
    RobotJob job;
    AdapterActions out;
    job.Handle(Planning::RecoverJob{MakeCommandedJob(), {}});
    REQUIRE(job.GetJobOrNull() != nullptr);
    CHECK(job.GetJobOrNull()->commandID == "C");
    job.OnDone("C", out);
    CHECK(out == AdapterActions{RaiseEvent{Planning::JobFinished{"J"}}});
    CHECK(job.GetJobOrNull() == nullptr);
}

} // namespace ACS::Acsd::Test

#include "fixtures/PlanWorldSteps.hpp"

#include <cstdint>
#include <limits>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::BeginPlan;
using ACS::Testing::FinishPlan;
using ACS::Testing::MakeControlPlan;
using ACS::Testing::MakeLogisticsPlan;
using ACS::Testing::PlanWorld;
using ACS::Testing::RestartEngine;
using ACS::Testing::TryRunUntil;

namespace
{

RobotWorkChanged MakeWork(std::int32_t jobNumber)
{
    RobotWorkChanged work;
    work.robotID = "LR01";
    work.nodeIDs = {"D-CHG01"};
    work.jobNumber = jobNumber;
    return work;
}

/// The number of the first job after a start on a store that has this number for the robot's last job.
std::int32_t GetNumberAfter(std::int32_t previous)
{
    PlanWorld world;
    REQUIRE(world.store.Append({{MakeWork(previous)}}).has_value());
    RestartEngine(world);
    world.Submit(MakeLogisticsPlan("P1"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-a4 Instructed"));
    return world.GetRobot("LR01").commandedJobs.front().jobNumber;
}

} // namespace

TEST_CASE("Each job of a robot has its own number, 1 to 2^31 - 1, which is stored with the command")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        INFO("seed " << seed);
        PlanWorld world(seed);
        BeginPlan(world, MakeControlPlan("P1"), "Job 1 P1-cd Instructed");
        const RobotWorkChanged& stored = world.store.GetState().robotWorks.back();
        REQUIRE(stored.job.has_value());
        CHECK(*stored.job == world.GetRobot("CR01").commandedJobs.front());
        CHECK(stored.jobNumber == stored.job->jobNumber);
        FinishPlan(world);
        const std::vector<StartJob>& jobs = world.GetRobot("CR01").commandedJobs;
        REQUIRE(jobs.size() == 6);
        for (std::size_t i = 0; i < jobs.size(); ++i)
        {
            CHECK(jobs[i].jobNumber >= 1);
            CHECK((i == 0 || jobs[i].jobNumber != jobs[i - 1].jobNumber));
        }
    }
}

TEST_CASE("A job's number differs from that of the robot's previous job, also after a restart")
{
    const std::int32_t drawn = GetNumberAfter(0);
    CHECK(GetNumberAfter(drawn) == drawn + 1);
    CHECK(GetNumberAfter(drawn - 1) == drawn);
}

TEST_CASE("A job whose outcome is requested after a restart keeps its number")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    RestartEngine(world);
    FinishPlan(world);
    const auto& robot = world.GetRobot("LR01");
    REQUIRE(robot.recoveredJobs.size() == 1);
    CHECK(robot.recoveredJobs.front() == robot.commandedJobs.front());
    CHECK(robot.recoveredJobs.front().jobNumber > 0);
}

TEST_CASE("A job that the robot never had is sent again under its number")
{
    PlanWorld world;
    world.GetRobot("LR01").bMissesJobs = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 Instructed");
    world.GetRobot("LR01").bMissesJobs = false;
    RestartEngine(world);
    FinishPlan(world);
    const std::vector<StartJob>& jobs = world.GetRobot("LR01").commandedJobs;
    REQUIRE(jobs.size() == 3);
    CHECK(jobs[1].jobID == "P1-a4");
    CHECK(jobs[1].commandID == jobs[0].commandID);
    CHECK(jobs[1].jobNumber == jobs[0].jobNumber);
    CHECK(jobs[2].jobNumber != jobs[1].jobNumber);
}

TEST_CASE("A job of an older version that the robot never had gets a number when it is sent again")
{
    PlanWorld world;
    world.GetRobot("LR01").bMissesJobs = true;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 Instructed");
    world.GetRobot("LR01").bMissesJobs = false;
    const std::vector<RobotWorkChanged>& works = world.store.GetState().robotWorks;
    RobotWorkChanged old = *std::ranges::find(works, "LR01", &RobotWorkChanged::robotID);
    old.jobNumber = 0;
    old.job->jobNumber = 0;
    REQUIRE(world.store.Append({{old}}).has_value());
    RestartEngine(world);
    FinishPlan(world);
    const auto& robot = world.GetRobot("LR01");
    CHECK(robot.recoveredJobs.front().jobNumber == 0);
    REQUIRE(robot.commandedJobs.size() == 3);
    CHECK(robot.commandedJobs[1].commandID == robot.commandedJobs[0].commandID);
    CHECK(robot.commandedJobs[1].jobNumber > 0);
}

TEST_CASE("A job that the operator has done again is another command and has another number")
{
    PlanWorld world;
    BeginPlan(world, MakeLogisticsPlan("P1"), "Job 1 P1-a4 InProgress");
    world.GetRobot("LR01").unresolvedReason = "it was switched off";
    RestartEngine(world);
    world.ResolveJob("P1", "P1-a4", EJobResolution::Again);
    REQUIRE(world.TryRun());
    const std::vector<StartJob>& jobs = world.GetRobot("LR01").commandedJobs;
    REQUIRE(jobs.size() >= 2);
    CHECK(jobs[1].jobID == "P1-a4");
    CHECK(jobs[1].commandID != jobs[0].commandID);
    CHECK(jobs[1].jobNumber != jobs[0].jobNumber);
}

#include "fixtures/PlanWorldSteps.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Testing::MakeWorld;
using ACS::Testing::PlanWorld;
using ACS::Testing::TryRunUntil;

namespace
{

/// Rejects the jobs for which the function returns a reason.
class FakeJobCheck final : public IJobCheck
{
    std::function<std::string(const StartJob&)> _describe;

public:
    explicit FakeJobCheck(std::function<std::string(const StartJob&)> describe)
        : _describe(std::move(describe))
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const StartJob& job) const override
    {
        std::string reason = _describe(job);
        return reason.empty() ? std::nullopt : std::optional(std::move(reason));
    }
};

void SetCheck(PlanWorld& world, const std::string& robotID, std::function<std::string(const StartJob&)> describe)
{
    world.Raise(robotID, JobCheckChanged{std::make_shared<const FakeJobCheck>(std::move(describe))});
}

std::string RejectUnloads(const StartJob& job)
{
    return job.action == "CassetteUnload" ? "no fork for CassetteUnload" : "";
}

/// A load and an unload: the last job is checked as well as the first.
Plan MakePlan(const std::string& planID, const std::string& robotID, const std::string& place = "A01.CP01")
{
    const std::string port = robotID + ".CP01";
    return {
        planID,
        "",
        1,
        {{1, "CassetteLoad", place, {"C1"}, {{planID + "-l", place, port}}},
         {2, "CassetteUnload", "A02.CP03", {"C1"}, {{planID + "-u", port, "A02.CP03"}}}}};
}

std::string GetOwner(const PlanWorld& world, const std::string& planID)
{
    return world.engine->GetPlanOrNull(planID)->robotID.value_or("");
}

} // namespace

TEST_CASE("A plan is assigned to a robot that can do all of its jobs, not to a nearer one")
{
    for (const std::string able : {"LR01", "LR02"})
    {
        PlanWorld world(1, true);
        SetCheck(world, able == "LR01" ? "LR02" : "LR01", RejectUnloads);
        world.Connect();
        world.Submit(MakePlan("P1", "AMR"));
        REQUIRE(world.TryRun());
        CHECK(GetOwner(world, "P1") == able);
        CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
    }
}

TEST_CASE("The jobs of a plan are checked once, for the robot that gets it and for no other")
{
    PlanWorld world(1, true);
    std::map<std::string, int> checked;
    for (const std::string robotID : {"LR01", "LR02"})
    {
        SetCheck(world, robotID, [&checked, robotID](const StartJob&) {
            ++checked[robotID];
            return std::string();
        });
    }
    world.Connect();
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(world.TryRun());
    CHECK(checked == std::map<std::string, int>{{GetOwner(world, "P1"), 2}});
}

TEST_CASE("A plan with a job that no robot can do waits with the reasons until one of them can")
{
    PlanWorld world(1, true);
    world.Connect();
    SetCheck(world, "LR01", RejectUnloads);
    SetCheck(world, "LR02", [](const StartJob& job) { return job.action + " is not listed"; });
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    const std::optional<WaitReason> reason = world.engine->GetWaitReasonOrNull("P1");
    REQUIRE(reason.has_value());
    CHECK(
        reason->message
        == "No robot can execute the plan: LR01: no fork for CassetteUnload; LR02: CassetteLoad is not listed.");
    CHECK(
        reason->robots
        == std::vector<RobotUnavailability>{
            {"LR01", "no fork for CassetteUnload"},
            {"LR02", "CassetteLoad is not listed"}});
    SetCheck(world, "LR02", [](const StartJob&) { return std::string(); });
    REQUIRE(world.TryRun());
    CHECK(GetOwner(world, "P1") == "LR02");
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A plan that names a robot waits for it, although another one could do it")
{
    PlanWorld world(1, true);
    world.Connect();
    SetCheck(world, "LR01", RejectUnloads);
    world.Submit(MakePlan("P1", "LR01"));
    REQUIRE(world.TryRun());
    CHECK(
        world.engine->GetWaitReasonOrNull("P1")->message
        == "No robot can execute the plan: LR01: no fork for CassetteUnload.");
    world.Raise("LR01", JobCheckChanged{nullptr});
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A robot is assigned the plans that it can do, and no other")
{
    PlanWorld world;
    world.Connect();
    SetCheck(world, "LR01", [](const StartJob& job) {
        return job.from == "A01.CP02" ? std::string("the job has no {station.height}") : std::string();
    });
    world.Submit(MakePlan("P1", "AMR", "A01.CP02"));
    world.Submit(MakePlan("P2", "AMR", "A01.CP03"));
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    CHECK(world.GetReportsOf("P2").back() == "Plan Completed");
}

TEST_CASE("Jobs are checked with the same command that the robot would receive")
{
    PlanWorld world;
    std::vector<StartJob> checked;
    SetCheck(world, "LR01", [&checked](const StartJob& job) {
        checked.push_back(job);
        return std::string();
    });
    world.Connect();
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(world.TryRun());
    std::vector<StartJob> commanded = world.GetRobot("LR01").commandedJobs;
    REQUIRE(commanded.size() == 2);
    for (StartJob& job : commanded)
    {
        job.commandID.clear();
        job.progressToken.clear();
        job.jobNumber = 0;
        job.nodeID.clear();
    }
    CHECK(checked == commanded);
}

TEST_CASE("A step without jobs is checked as the command that its robot would receive")
{
    PlanWorld world;
    world.Connect();
    SetCheck(world, "CR01", [](const StartJob& job) { return job.action + " at " + job.position; });
    world.Submit({"P1", "", 1, {{1, "OpenSetCover", "A01.SET01", {}, {}}}});
    REQUIRE(world.TryRun());
    CHECK(
        world.engine->GetWaitReasonOrNull("P1")->message
        == "No robot can execute the plan: CR01: OpenSetCover at A01.SET01.");
}

TEST_CASE("A plan that a robot has stays with it, also when the robot's abilities change")
{
    PlanWorld world(1, true);
    world.Connect();
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(TryRunUntil(world, "P1", "Job 1 P1-l InProgress"));
    const std::string robotID = GetOwner(world, "P1");
    SetCheck(world, robotID, RejectUnloads);
    REQUIRE(world.TryRun());
    CHECK(GetOwner(world, "P1") == robotID);
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("A waiting plan is checked again after a restart")
{
    PlanWorld world;
    world.Connect();
    SetCheck(world, "LR01", RejectUnloads);
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(world.TryRun());
    world.Restart(ACS::Testing::MakeTestOptions(false), ACS::Testing::MakeTestSite());
    SetCheck(world, "LR01", RejectUnloads);
    world.Connect();
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").empty());
    SetCheck(world, "LR01", [](const StartJob&) { return std::string(); });
    REQUIRE(world.TryRun());
    CHECK(world.GetReportsOf("P1").back() == "Plan Completed");
}

TEST_CASE("D-24 The first report of a plan that no robot can do has the reason")
{
    PlanWorld world = MakeWorld([](EngineOptions& options) { options.bInitialPendingReported = true; });
    world.Connect();
    SetCheck(world, "LR01", RejectUnloads);
    world.Submit(MakePlan("P1", "AMR"));
    REQUIRE(world.TryRun());
    REQUIRE(world.reports.size() == 1);
    CHECK(
        std::get<PlanReport>(world.reports.front().report).message
        == "No robot can execute the plan: LR01: no fork for CassetteUnload.");
}

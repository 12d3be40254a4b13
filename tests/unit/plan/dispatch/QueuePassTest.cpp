#include "dispatch/QueuePass.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures
using namespace std::chrono_literals;

namespace
{

EngineOptions MakeOptions(std::chrono::milliseconds overtaking)
{
    EngineOptions options = MakeTestOptions(true);
    options.queueOvertaking = overtaking;
    return options;
}

/// Rejects jobs at A01.CP01.
struct OneStationCheck final : IJobCheck
{
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const StartJob& job) const override
    {
        return job.position == "A01.CP01" ? std::optional<std::string>("too heavy") : std::nullopt;
    }
};

/// LR01 is on its parking position. The map is one-way: of the stations A01.CP01 is the nearest, A01.CP05 is far.
struct QueuePassFixture
{
    EngineParts parts;
    Robot& other = parts.engine.fleet[2]; ///< LR02, offline.

    explicit QueuePassFixture(std::chrono::milliseconds overtaking = 1min)
        : parts(MakeOptions(overtaking))
    {
        parts.PutOn(parts.lr, "D-CHG01");
    }

    ActivePlan& Add(
        const std::string& planID,
        const std::string& from,
        const std::string& to,
        const std::string& robot = "AMR",
        std::optional<std::int32_t> priorityOrNull = {})
    {
        Plan plan = MakeLogisticsPlan(planID);
        plan.priority = priorityOrNull;
        plan.steps[0].position = from;
        plan.steps[0].jobs[0] = {planID + "-load", from, robot + ".CP01"};
        plan.steps[1].position = to;
        plan.steps[1].jobs[0] = {planID + "-unload", robot + ".CP01", to};
        return parts.Add(plan);
    }

    /// The plans that begin, each with its robot.
    [[nodiscard]] Lines Run()
    {
        FreeRobots free(parts.engine.fleet);
        QueuePass pass(parts.engine, parts.coordinator.GetVisits(), parts.dispatcher, free);
        Lines begun;
        while (const std::optional<QueuePass::Choice> choice = pass.FindNextOrNull())
        {
            begun.push_back(choice->plan.record.plan.planID + " " + choice->robot.GetID());
            parts.assignment.Offer(choice->plan, choice->robot);
        }
        return begun;
    }
};

} // namespace

TEST_CASE("QueuePass: without overtaking, plans begin in the order of the queue")
{
    QueuePassFixture fixture(0ms);
    fixture.Add("far", "A01.CP05", "A02.CP03");
    fixture.Add("near", "A01.CP01", "A02.CP04");
    CHECK(fixture.Run() == Lines{"far LR01"});
    CHECK(fixture.Run() == Lines{});
}

TEST_CASE("QueuePass: plans without a free robot do not count for the limit of a pass")
{
    QueuePassFixture fixture(0ms);
    fixture.parts.lr.view.bOnline = false;
    fixture.parts.PutOn(fixture.parts.cr, "D-CHG02");
    for (int i = 0; i < 1'000; ++i)
    {
        fixture.Add("LR-" + std::to_string(i), "A01.CP05", "A02.CP03");
    }
    Plan last = MakeControlPlan("CR");
    last.priority.reset();
    fixture.parts.Add(last);
    CHECK(fixture.Run() == Lines{"CR CR01"});
}

TEST_CASE("QueuePass: plans with a blocked station do not count for the limit of a pass")
{
    QueuePassFixture fixture(0ms);
    const bool bStation = GENERATE(true, false);
    fixture.parts.engine.blocks.Add(
        {bStation ? EBlockKind::Station : EBlockKind::Node, bStation ? "A01.CP01" : "D-A01.CP01", "oil", {}});
    fixture.parts.coordinator.OnBlocksChanged();
    for (int i = 0; i < 1'000; ++i)
    {
        fixture.Add("from-" + std::to_string(i), "A01.CP01", "A02.CP03");
        fixture.Add("to-" + std::to_string(i), "A01.CP02", "A01.CP01");
    }
    fixture.Add("open", "A01.CP05", "A02.CP04");
    CHECK(fixture.Run() == Lines{"open LR01"});
}

TEST_CASE("QueuePass: plans whose station another robot uses do not count for the limit of a pass")
{
    QueuePassFixture fixture(0ms);
    fixture.Add("first", "A01.CP01", "A02.CP03");
    CHECK(fixture.Run() == Lines{"first LR01"});
    fixture.parts.PutOn(fixture.other, "D-CHG03");
    for (int i = 0; i < 1'000; ++i)
    {
        fixture.Add("taken-" + std::to_string(i), "A01.CP01", "A02.CP04");
    }
    fixture.Add("open", "A01.CP05", "A01.CP04");
    CHECK(fixture.Run() == Lines{"open LR02"});
}

TEST_CASE("QueuePass: plans that are known to be rejected by the free robots do not count for the limit of a pass")
{
    QueuePassFixture fixture(0ms);
    fixture.parts.lr.view.jobCheck = std::make_shared<const OneStationCheck>();
    for (int i = 0; i < 1'000; ++i)
    {
        fixture.Add("heavy-" + std::to_string(i), "A01.CP01", "A02.CP03");
    }
    fixture.Add("open", "A01.CP05", "A02.CP04");
    CHECK(fixture.Run() == Lines{}); // the check is asked for each plan
    CHECK(fixture.Run() == Lines{"open LR01"});
}

TEST_CASE("queue.overtaking: the robot gets the plan with the shortest empty drive")
{
    QueuePassFixture fixture;
    fixture.Add("far", "A01.CP05", "A02.CP03");
    fixture.Add("nearer", "A01.CP04", "A01.CP06");
    fixture.Add("near", "A01.CP01", "A02.CP04");
    CHECK(fixture.Run() == Lines{"near LR01"});
    fixture.parts.PutOn(fixture.other, "D-CHG03");
    CHECK(fixture.Run() == Lines{"nearer LR02"});
}

TEST_CASE("queue.overtaking: the plan that is overtaken gets the next robot of the same pass")
{
    QueuePassFixture fixture;
    fixture.parts.PutOn(fixture.other, "D-CHG03");
    fixture.Add("far", "A01.CP05", "A02.CP03");
    fixture.Add("near", "A01.CP01", "A02.CP04");
    CHECK(fixture.Run() == Lines{"near LR01", "far LR02"});
}

TEST_CASE("queue.overtaking: a plan is overtaken only by plans that were accepted within this time after it")
{
    for (const auto seconds : {60, 61})
    {
        QueuePassFixture fixture;
        fixture.Add("far", "A01.CP05", "A02.CP03");
        fixture.parts.Advance(std::chrono::seconds(seconds));
        fixture.parts.engine.plans.BeginCall(fixture.parts.engine.transaction.GetNow().steady);
        fixture.Add("near", "A01.CP01", "A02.CP04");
        CHECK(fixture.Run() == Lines{seconds == 60 ? "near LR01" : "far LR01"});
    }
}

TEST_CASE("queue.overtaking: no plan of another priority overtakes or is overtaken")
{
    QueuePassFixture fixture(1h);
    fixture.Add("far", "A01.CP05", "A02.CP03", "AMR", 5);
    fixture.Add("less urgent", "A01.CP01", "A02.CP04", "AMR", 4);
    SECTION("by its age, the plan of another priority is before this one")
    {
        fixture.parts.Advance(20min);
        fixture.parts.engine.plans.BeginCall(fixture.parts.engine.transaction.GetNow().steady);
        fixture.Add("near", "A01.CP02", "A01.CP06", "AMR", 5);
    }
    CHECK(fixture.Run() == Lines{"far LR01"});
}

TEST_CASE("queue.overtaking: plans that share a station keep their order")
{
    QueuePassFixture fixture;
    fixture.Add("far", "A01.CP05", "A02.CP03");
    fixture.Add("between", "A01.CP06", "A02.CP04");
    SECTION("with the first one")
    {
        fixture.Add("near", "A01.CP01", "A02.CP03");
    }
    SECTION("with one between them")
    {
        fixture.Add("near", "A01.CP01", "A02.CP04");
    }
    CHECK(fixture.Run() == Lines{"far LR01"});
}

TEST_CASE("queue.overtaking: 16 plans are compared with the first one")
{
    for (const int between : {15, 16})
    {
        QueuePassFixture fixture;
        fixture.Add("far", "A01.CP05", "A02.CP03");
        for (int i = 0; i < between; ++i)
        {
            fixture.Add("P" + std::to_string(i), "A01.CP05", "A02.CP03");
        }
        fixture.Add("near", "A01.CP01", "A02.CP04");
        CHECK(fixture.Run() == Lines{between == 15 ? "near LR01" : "far LR01"});
    }
}

TEST_CASE("queue.overtaking: no plan overtakes to which another free robot is nearer")
{
    QueuePassFixture fixture;
    fixture.parts.PutOn(fixture.other, "D-A01.CP01");
    fixture.Add("far", "A01.CP05", "A02.CP03", "LR01");
    fixture.Add("near", "A01.CP02", "A02.CP04");
    CHECK(fixture.Run() == Lines{"far LR01", "near LR02"});
}

TEST_CASE("queue.overtaking: the robot must be able to do the plan that overtakes")
{
    QueuePassFixture fixture;
    fixture.Add("far", "A01.CP05", "A02.CP03");
    SECTION("it is not a candidate")
    {
        fixture.Add("near", "A01.CP01", "A02.CP04", "LR02");
    }
    SECTION("its dock is blocked")
    {
        fixture.Add("near", "A01.CP01", "A02.CP04");
        fixture.parts.engine.blocks.Add({EBlockKind::Node, "D-A01.CP01", "oil", {}});
        fixture.parts.coordinator.OnBlocksChanged();
    }
    CHECK(fixture.Run() == Lines{"far LR01"});
}

#include "dispatch/QueuePass.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorldSteps.hpp"

#include <chrono>
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

/// LR01 is on its parking position. The map is one-way: of the stations A01.CP01 is the nearest, A01.CP05 is far.
struct Floor
{
    EngineParts parts;
    Robot& other = parts.engine.fleet[2]; ///< LR02, offline.

    explicit Floor(std::chrono::milliseconds overtaking = 1min)
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
    Floor floor(0ms);
    floor.Add("far", "A01.CP05", "A02.CP03");
    floor.Add("near", "A01.CP01", "A02.CP04");
    CHECK(floor.Run() == Lines{"far LR01"});
    CHECK(floor.Run() == Lines{});
}

TEST_CASE("queue.overtaking: the robot gets the plan with the shortest empty drive")
{
    Floor floor;
    floor.Add("far", "A01.CP05", "A02.CP03");
    floor.Add("nearer", "A01.CP04", "A01.CP06");
    floor.Add("near", "A01.CP01", "A02.CP04");
    CHECK(floor.Run() == Lines{"near LR01"});
    floor.parts.PutOn(floor.other, "D-CHG03");
    CHECK(floor.Run() == Lines{"nearer LR02"});
}

TEST_CASE("queue.overtaking: the plan that is overtaken gets the next robot of the same pass")
{
    Floor floor;
    floor.parts.PutOn(floor.other, "D-CHG03");
    floor.Add("far", "A01.CP05", "A02.CP03");
    floor.Add("near", "A01.CP01", "A02.CP04");
    CHECK(floor.Run() == Lines{"near LR01", "far LR02"});
}

TEST_CASE("queue.overtaking: a plan is overtaken only by plans that were accepted within this time after it")
{
    for (const auto seconds : {60, 61})
    {
        Floor floor;
        floor.Add("far", "A01.CP05", "A02.CP03");
        floor.parts.Advance(std::chrono::seconds(seconds));
        floor.parts.engine.plans.BeginCall(floor.parts.engine.transaction.GetNow().steady);
        floor.Add("near", "A01.CP01", "A02.CP04");
        CHECK(floor.Run() == Lines{seconds == 60 ? "near LR01" : "far LR01"});
    }
}

TEST_CASE("queue.overtaking: a plan of another priority does not overtake")
{
    Floor floor;
    floor.Add("far", "A01.CP05", "A02.CP03", "AMR", 5);
    floor.Add("less urgent", "A01.CP01", "A02.CP04", "AMR", 4);
    CHECK(floor.Run() == Lines{"far LR01"});
}

TEST_CASE("queue.overtaking: plans that share a station keep their order")
{
    Floor floor;
    floor.Add("far", "A01.CP05", "A02.CP03");
    floor.Add("between", "A01.CP06", "A02.CP04");
    SECTION("with the first one")
    {
        floor.Add("near", "A01.CP01", "A02.CP03");
    }
    SECTION("with one between them")
    {
        floor.Add("near", "A01.CP01", "A02.CP04");
    }
    CHECK(floor.Run() == Lines{"far LR01"});
}

TEST_CASE("queue.overtaking: 16 plans are compared with the first one")
{
    for (const int between : {15, 16})
    {
        Floor floor;
        floor.Add("far", "A01.CP05", "A02.CP03");
        for (int i = 0; i < between; ++i)
        {
            floor.Add("P" + std::to_string(i), "A01.CP05", "A02.CP03");
        }
        floor.Add("near", "A01.CP01", "A02.CP04");
        CHECK(floor.Run() == Lines{between == 15 ? "near LR01" : "far LR01"});
    }
}

TEST_CASE("queue.overtaking: no plan overtakes to which another free robot is nearer")
{
    Floor floor;
    floor.parts.PutOn(floor.other, "D-A01.CP01");
    floor.Add("far", "A01.CP05", "A02.CP03", "LR01");
    floor.Add("near", "A01.CP02", "A02.CP04");
    CHECK(floor.Run() == Lines{"far LR01", "near LR02"});
}

TEST_CASE("queue.overtaking: the robot must be able to do the plan that overtakes")
{
    Floor floor;
    floor.Add("far", "A01.CP05", "A02.CP03");
    SECTION("it is not a candidate")
    {
        floor.Add("near", "A01.CP01", "A02.CP04", "LR02");
    }
    SECTION("its dock is blocked")
    {
        floor.Add("near", "A01.CP01", "A02.CP04");
        floor.parts.engine.blocks.Add({EBlockKind::Node, "D-A01.CP01", "oil", {}});
        floor.parts.coordinator.OnBlocksChanged();
    }
    CHECK(floor.Run() == Lines{"far LR01"});
}

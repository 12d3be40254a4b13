#include "operator/AcsdMetrics.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "operator/WaitCauses.hpp"

#include <chrono>
#include <string>

namespace ACS::Acsd::Test
{

using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace
{

/// The causes that count at least one plan, with their numbers: "paused 1 queue 2".
std::string ListCauses(const Testing::PlanWorld& world, bool bStoreFailing = false)
{
    std::string text;
    for (const auto& [cause, count] : CountWaitCauses(*world.engine, bStoreFailing))
    {
        if (count > 0)
        {
            text += (text.empty() ? "" : " ") + std::string(cause) + ' ' + std::to_string(count);
        }
    }
    return text;
}

/// The metrics of the plans, robots and alarms of a floor.
struct MetricsOfFloor
{
    Testing::PlanWorld world;
    Apps::MetricsEndpoint endpoint;
    AcsdMetrics metrics{endpoint, world.GetNow()};

    [[nodiscard]] std::string Render()
    {
        metrics.UpdatePlans(*world.engine, false, world.GetNow());
        return endpoint.Render();
    }
};

} // namespace

TEST_CASE("Plans that wait are counted by cause")
{
    Testing::PlanWorld world;
    CHECK(CountWaitCauses(*world.engine, false).size() == 7);
    world.Submit(Testing::MakeLogisticsPlan("P1")); // no robot is connected
    world.Submit(Testing::MakeLogisticsPlan("P2"));
    CHECK(ListCauses(world) == "queue 2");
    CHECK(ListCauses(world, true) == "store 2");
    world.SwitchTSC(true);
    CHECK(ListCauses(world, true) == "tsc 2");
    world.SwitchTSC(false);
    world.Connect();
    REQUIRE(Testing::TryRunUntil(world, "P1", "Step 1 InProgress"));
    CHECK(ListCauses(world) == "queue 1");
    Testing::PausePlan(world);
    CHECK(ListCauses(world) == "paused 1 queue 1");
    world.Control(Planning::EPlanControl::Resume, "P1");
    REQUIRE(Testing::TryRunUntil(world, "P1", "ResumeResult Success"));
    world.Raise("LR01", Planning::LinkChanged{false});
    CHECK(ListCauses(world) == "queue 1 robot 1");
}

TEST_CASE("A plan whose robot waits for its route, and one whose job has no known outcome, have causes of their own")
{
    Testing::PlanWorld world;
    Testing::BeginRouteWait(world);
    CHECK(world.TryRun([&world] { return ListCauses(world) == "route 1"; }));

    Testing::PlanWorld other;
    Testing::BeginPlan(other, Testing::MakeLogisticsPlan("P1"), "Step 1 InProgress");
    REQUIRE(other.TryRun([&other] { return other.engine->GetRobotStatuses().front().jobID.has_value(); }));
    other.GetRobot("LR01").unresolvedReason = "it was switched off";
    Testing::RestartEngine(other);
    CHECK(ListCauses(other) == "job 1");
}

TEST_CASE("The age of the oldest plan that has not started follows the queue")
{
    Testing::PlanWorld world;
    Apps::MetricsEndpoint endpoint;
    AcsdMetrics metrics(endpoint, world.GetNow());
    const auto render = [&](Core::Duration later) {
        Core::Now now = world.GetNow();
        now.wall += std::chrono::duration_cast<Core::WallTime::duration>(later);
        metrics.UpdatePlans(*world.engine, false, now);
        return endpoint.Render();
    };
    CHECK_THAT(render(5s), Contains("\nacsd_queue_oldest_seconds 0\n"));
    world.Submit(Testing::MakeLogisticsPlan("P1"));
    const std::string text = render(5s);
    CHECK_THAT(text, Contains("\nacsd_queue_oldest_seconds 5\n"));
    CHECK_THAT(text, Contains("acsd_plans{status=\"Pending\"} 1\n"));
    CHECK_THAT(text, Contains("acsd_plans_waiting{cause=\"queue\"} 1\n"));
    CHECK_THAT(text, Contains("acsd_plans_waiting{cause=\"route\"} 0\n"));
    CHECK_THAT(text, Contains("\nacsd_store_failing 0\n"));
    CHECK_THAT(text, Contains("acsd_tsc_state{state=\"Auto\"} 1\n"));
    CHECK_THAT(render(-5s), Contains("\nacsd_queue_oldest_seconds 0\n")); // the wall clock was set back
}

TEST_CASE("acsd is ready while every link is up and nothing else prevents it")
{
    Apps::MetricsEndpoint endpoint;
    AcsdMetrics metrics(endpoint, Core::Now());
    metrics.UpdateReady({{"mcs", true}, {"mqtt", true}}, true);
    CHECK_THAT(endpoint.Render(), Contains("acsd_ready 1\n") && Contains("acsd_link_up{link=\"mqtt\"} 1\n"));
    metrics.UpdateReady({{"mcs", true}, {"mqtt", true}}, false);
    CHECK_THAT(endpoint.Render(), Contains("acsd_ready 0\n"));
    metrics.UpdateReady({{"mcs", true}, {"mqtt", false}}, true);
    CHECK_THAT(endpoint.Render(), Contains("acsd_ready 0\n") && Contains("acsd_link_up{link=\"mqtt\"} 0\n"));
}

TEST_CASE("The maintenance of each robot has a series, also of one that is not connected")
{
    MetricsOfFloor floor;
    CHECK_THAT(floor.Render(), Contains("acsd_robot_maintenance{robot=\"LR01\"} 0\n"));
    floor.world.Ask(Planning::SetMaintenance{"LR01", true, 0});
    CHECK_THAT(floor.Render(), Contains("acsd_robot_maintenance{robot=\"LR01\"} 1\n"));
    floor.world.Ask(Planning::SetMaintenance{"LR01", false, 0});
    CHECK_THAT(floor.Render(), Contains("acsd_robot_maintenance{robot=\"LR01\"} 0\n"));
}

TEST_CASE("An alarm has its series while it is active")
{
    MetricsOfFloor floor;
    CHECK_THAT(
        floor.Render(),
        Contains("acsd_alarms_active{level=\"heavy\"} 0\n") && !Contains("acsd_alarms_by_code{"));
    floor.world.Connect();
    floor.world.Raise("LR01", Planning::LinkChanged{false});
    REQUIRE(floor.world.TryRun([&floor] { return !floor.world.engine->GetActiveAlarms().empty(); }));
    CHECK_THAT(floor.Render(), Contains(R"(acsd_alarms_by_code{code="ACS-1002",level="heavy",robot="LR01"} 1)"));
    floor.world.Raise("LR01", Planning::LinkChanged{true});
    REQUIRE(floor.world.TryRun([&floor] { return floor.world.engine->GetActiveAlarms().empty(); }));
    CHECK_THAT(floor.Render(), !Contains("acsd_alarms_by_code{"));
}

} // namespace ACS::Acsd::Test

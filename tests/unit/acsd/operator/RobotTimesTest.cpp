#include "operator/RobotTimes.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "ManualClock.hpp"

#include <algorithm>
#include <chrono>
#include <string>

namespace ACS::Acsd::Test
{

using Catch::Matchers::Contains;
using namespace std::chrono_literals;

TEST_CASE("The time of each status is counted, and only statuses that occurred have series")
{
    Testing::ManualClock clock;
    Apps::MetricsEndpoint metrics;
    RobotTimes times(metrics);
    Planning::RobotStatus status;
    status.robotID = "LR01";
    const auto change = [&](Planning::ERobotStatus value) {
        status.status = value;
        times.OnStatusChanged(status, clock.GetNow());
    };
    change(Planning::ERobotStatus::Disconnected);
    clock.Advance(3s);
    change(Planning::ERobotStatus::Idle);
    clock.Advance(1s);
    change(Planning::ERobotStatus::Idle); // another member of the status has changed
    clock.Advance(1s);
    change(Planning::ERobotStatus::Disconnected);
    clock.JumpWall(24h);
    const std::string text = metrics.Render();
    CHECK_THAT(text, Contains(R"(acsd_robot_status_seconds_total{robot="LR01",status="Disconnected"} 3)"));
    CHECK_THAT(text, Contains(R"(acsd_robot_status_seconds_total{robot="LR01",status="Idle"} 2)"));
    CHECK_THAT(text, Contains(R"(acsd_robot_state{robot="LR01",state="Disconnected"} 1)"));
    CHECK_THAT(text, Contains(R"(acsd_robot_state{robot="LR01",state="Idle"} 0)"));
    CHECK_THAT(text, !Contains("Moving"));
}

TEST_CASE("The time for which a robot waits for another one to clear its route is counted")
{
    Testing::PlanWorld world;
    Apps::MetricsEndpoint metrics;
    RobotTimes times(metrics);
    Testing::BeginPlan(world, Testing::MakeControlPlan("P0"), "Step 1 InProgress");
    times.Sample(*world.engine, world.GetNow());
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="CR01"} 0)"));
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="LR01"} 0)"));
    REQUIRE(world.TryRun());

    Testing::BeginRouteWait(world);
    const auto isWaiting = [&world] {
        const auto statuses = world.engine->GetRobotStatuses();
        const auto robot = std::ranges::find(statuses, "CR01", &Planning::RobotStatus::robotID);
        return robot->message.find("to clear its route") != std::string::npos;
    };
    REQUIRE(world.TryRun(isWaiting));
    Core::Now now = world.GetNow();
    times.Sample(*world.engine, now);
    now.steady += 1s;
    times.Sample(*world.engine, now);
    now.steady += 2s;
    times.Sample(*world.engine, now);
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="CR01"} 3)"));
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="LR01"} 0)"));

    world.Raise("CR01", Planning::LinkChanged{false}); // from now on another thing keeps it from driving
    now.steady += 1s;
    times.Sample(*world.engine, now);
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="CR01"} 3)"));
}

TEST_CASE("A robot that drives does not wait for its route")
{
    Testing::PlanWorld world;
    Apps::MetricsEndpoint metrics;
    RobotTimes times(metrics);
    world.Connect();
    world.Submit(Testing::MakeLogisticsPlan("P1"));
    REQUIRE(world.TryRun([&] {
        times.Sample(*world.engine, world.GetNow());
        return Testing::Contains(world.GetReportsOf("P1"), "Plan Completed");
    }));
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_route_wait_seconds_total{robot="LR01"} 0)"));
    CHECK_THAT(metrics.Render(), Contains(R"(acsd_robot_status_seconds_total{robot="LR01",status="Working"})"));
}

} // namespace ACS::Acsd::Test

#include "operator/PlanLog.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace ACS::Acsd::Test
{

TEST_CASE("A robot with ever new errors does not flood the log or hide the alarms of another one")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    Planning::Alarm alarm;
    alarm.robotID = "LR01";
    for (int number = 0; number < 1'000; ++number)
    {
        alarm.errorCode = "AGV-" + std::to_string(number);
        log.OnAlarmChanged(alarm, true, "T", clock.GetNow());
    }
    CHECK(sink.GetLines().size() == 20);
    CHECK(sink.ContainsField("errorCode", "AGV-19"));
    alarm.robotID = "LR02";
    log.OnAlarmChanged(alarm, true, "T", clock.GetNow());
    CHECK(sink.GetLines().back().HasField("robotId", "LR02"));
    alarm.robotID = "LR01";
    clock.Advance(Apps::LogRateLimiter::INTERVAL);
    log.OnAlarmChanged(alarm, false, "T", clock.GetNow());
    CHECK(sink.GetLines().back().message == "alarm cleared (980 similar lines suppressed)");
    CHECK(metrics.Respond().body.find("acsd_alarms_set_total") != std::string::npos);
}

TEST_CASE("A robot that keeps connecting does not flood the log or hide its other changes or those of another one")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    Planning::RobotStatus status;
    status.robotID = "LR01";
    status.position = "A01";
    for (int count = 0; count < 1'000; ++count)
    {
        status.status = count % 2 == 0 ? Planning::ERobotStatus::Disconnected : Planning::ERobotStatus::Idle;
        log.OnRobotStatusChanged(status, clock.GetNow());
    }
    CHECK(sink.GetLines().size() == 40);
    status.position = "A02";
    log.OnRobotStatusChanged(status, clock.GetNow());
    status.robotID = "LR02";
    status.position = "A01";
    log.OnRobotStatusChanged(status, clock.GetNow());
    CHECK(sink.GetLines().size() == 42);
    clock.Advance(std::chrono::minutes(1));
    status.robotID = "LR01";
    log.OnRobotStatusChanged(status, clock.GetNow());
    CHECK(sink.GetLines().back().message == "robot (480 similar lines suppressed)");
}

TEST_CASE("Repeated deviations of a robot are rate-limited by kind")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    for (int count = 0; count < 100; ++count)
    {
        log.OnNote("LR01", "one way", clock.GetNow());
    }
    log.OnNote("LR01", "another way", clock.GetNow());
    CHECK(sink.GetLines().size() == Apps::LogRateLimiter::BURST + 1);
}

namespace
{

Planning::PlanRecord MakeRecord(const Planning::Plan& plan)
{
    Planning::PlanRecord record;
    record.plan = plan;
    for (const Planning::Step& step : plan.steps)
    {
        record.progress.steps.push_back(
            {Planning::EStepState::Pending, {step.jobs.size(), Planning::EJobState::Pending}});
    }
    return record;
}

} // namespace

TEST_CASE("The time of a step is observed by its action, from its assignment to its end")
{
    Testing::ManualClock clock;
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    Planning::PlanRecord record = MakeRecord(Testing::MakeLogisticsPlan("P1"));
    const auto change = [&](std::size_t index, Planning::EStepState state) {
        const Planning::EStepState from = std::exchange(record.progress.steps[index].state, state);
        log.OnStepChanged(record, index, from, "T", clock.GetNow());
    };
    change(0, Planning::EStepState::Dispatched);
    clock.Advance(std::chrono::seconds(1));
    change(0, Planning::EStepState::Dispatched); // another robot has taken it over
    clock.Advance(std::chrono::seconds(7));
    change(0, Planning::EStepState::InProgress);
    clock.Advance(std::chrono::seconds(9));
    change(0, Planning::EStepState::Completed);
    change(1, Planning::EStepState::Dispatched);
    change(1, Planning::EStepState::InProgress);
    change(1, Planning::EStepState::Skipped);
    const std::string series = "acsd_step_duration_seconds_sum{action=\"" + record.plan.steps[0].action + "\"} 16\n";
    CHECK_THAT(metrics.Render(), Catch::Contains(series));
    CHECK_THAT(
        metrics.Render(),
        !Catch::Contains("acsd_step_duration_seconds_sum{action=\"" + record.plan.steps[1].action));
}

TEST_CASE("The time without a change of a plan in progress is measured from the last change of plan, step or job")
{
    Testing::PlanWorld world;
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    Testing::BeginPlan(world, Testing::MakeLogisticsPlan("P1"), "Step 1 InProgress");
    Core::Now now = world.GetNow();
    const auto render = [&] {
        log.Sample(*world.engine, now);
        return metrics.Render();
    };
    CHECK_THAT(render(), Catch::Contains("acsd_plan_unchanged_seconds 0\n")); // the plan was not seen before
    now.steady += std::chrono::seconds(4);
    CHECK_THAT(render(), Catch::Contains("acsd_plan_unchanged_seconds 4\n"));
    Planning::PlanRecord record = MakeRecord(Testing::MakeLogisticsPlan("P1"));
    record.progress.state = Planning::EPlanState::InProgress;
    log.OnStepChanged(record, 0, Planning::EStepState::Pending, "T", now);
    now.steady += std::chrono::seconds(2);
    CHECK_THAT(render(), Catch::Contains("acsd_plan_unchanged_seconds 2\n"));
    REQUIRE(world.TryRun());
    CHECK_THAT(render(), Catch::Contains("acsd_plan_unchanged_seconds 0\n"));
}

TEST_CASE("Counters that can be alerted on begin with 0, for the actions that the robots of the site have")
{
    Testing::RecordingLogSink sink;
    Apps::MetricsEndpoint metrics;
    PlanLog log(Core::Logger(sink, "plan"), metrics);
    Planning::EngineOptions options = Testing::MakeTestOptions(false);
    std::erase_if(options.robots, [](const auto& robot) { return robot.type == Planning::ERobotType::CR; });
    log.CreateSeries(options);
    const std::string text = metrics.Render();
    CHECK_THAT(text, Catch::Contains("acsd_plan_changes_total{status=\"Failed\"} 0\n"));
    CHECK_THAT(text, Catch::Contains("acsd_alarms_set_total{level=\"heavy\"} 0\n"));
    CHECK_THAT(text, Catch::Contains("acsd_job_failures_total{action=\"CassetteLoad\"} 0\n"));
    CHECK_THAT(text, !Catch::Contains("action=\"MemoryPickAndPlace\""));
    CHECK_THAT(text, Catch::Contains("acsd_robot_notes_total{robot=\"LR01\"} 0\n"));
    CHECK_THAT(text, Catch::Contains("acsd_plan_wait_seconds_count 0\n"));
}

} // namespace ACS::Acsd::Test

#include "operator/PlanLog.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"

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

} // namespace ACS::Acsd::Test

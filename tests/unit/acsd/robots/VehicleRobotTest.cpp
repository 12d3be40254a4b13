#include "robots/VehicleRobot.hpp"

#include "common/log/LogRateLimiter.hpp"
#include "config/ExampleSite.hpp"
#include "drivers/DriverMetrics.hpp"
#include "drivers/OpenStreamService.hpp"
#include "drivers/RecordingLink.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd::Test
{

namespace
{

/// The robot LR01 of the example site, whose vehicle goes online and offline.
struct VehicleRobotFixture
{
    static constexpr std::string_view UNSENT = "a message to the vehicle could not be sent";

    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    RecordingLink mqtt;
    Testing::RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    DriverMetrics ofRobot{metrics, "", "LR01"};
    OpenStreamService openStream{{context.get_executor(), clock, random, Core::Logger(log, "acsd")}, "LR01"};
    AcsdConfig config = ReadSite({});
    VehicleRobot robot{MakeServices(), FindVehicle("LR01")};

    VehicleRobotFixture()
    {
        mqtt.bFails = true;
        robot.Start();
    }

    [[nodiscard]] RobotServices MakeServices()
    {
        return {
            context.get_executor(),
            clock,
            random,
            Core::Logger(log, "robot"),
            ofRobot,
            [this](const RobotServices::AdapterCall& adapterCall) { Call(adapterCall); },
            [](ETraceDirection, std::string_view) {},
            openStream,
            &mqtt};
    }

    [[nodiscard]] std::shared_ptr<const VehicleConfig> FindVehicle(std::string_view robotID) const
    {
        return *std::ranges::find_if(config.vehicles, [robotID](const auto& vehicle) {
            return vehicle->robotID == robotID;
        });
    }

    /// Timers and events of the adapter have no effect.
    void Call(const RobotServices::AdapterCall& adapterCall)
    {
        Planning::AdapterActions actions;
        adapterCall(clock.GetNow(), actions);
        robot.OnAdapterCalled();
    }

    void Connect() const
    {
        mqtt.listenerOrNull->OnLinkDown({});
        mqtt.listenerOrNull->OnLinkUp();
        mqtt.listenerOrNull->OnMqttMessage(
            {"uagv/v2/ACS/LR01/connection",
             R"({"headerId":1,"timestamp":"2025-07-02T12:00:00.00Z","version":"2.0.0","manufacturer":"ACS",)"
             R"("serialNumber":"LR01","connectionState":"ONLINE"})",
             1,
             false});
    }

    [[nodiscard]] std::size_t CountWarnings() const
    {
        return static_cast<std::size_t>(std::ranges::count_if(log.GetLines(), [](const Testing::RecordedLine& line) {
            return line.message.starts_with(UNSENT);
        }));
    }
};

} // namespace

TEST_CASE_METHOD(VehicleRobotFixture, "Messages that cannot be sent are logged at a limited rate")
{
    Connect();
    REQUIRE(mqtt.attempts > 0);
    CHECK(CountWarnings() == mqtt.attempts);
    while (mqtt.attempts < 100)
    {
        Connect();
    }
    CHECK(CountWarnings() == Apps::LogRateLimiter::BURST);
    clock.Advance(Apps::LogRateLimiter::INTERVAL);
    const std::size_t suppressed = mqtt.attempts - Apps::LogRateLimiter::BURST;
    Connect();
    const std::string line = std::string(UNSENT) + " (" + std::to_string(suppressed) + " similar lines suppressed)";
    CHECK(std::ranges::count(log.GetLines(), line, &Testing::RecordedLine::message) == 1);
}

TEST_CASE_METHOD(VehicleRobotFixture, "A vehicle subscribes at its start, and its metrics have their names of acsd")
{
    CHECK(std::ranges::count(mqtt.filters, "uagv/v2/ACS/LR01/state") == 1);
    robot.UpdateMetrics();
    CHECK_THAT(metrics.Render(), !Catch::Contains("acsd_robot_last_seen_seconds{"));
    Connect();
    clock.Advance(std::chrono::seconds(3));
    robot.UpdateMetrics();
    const std::string text = metrics.Render();
    CHECK_THAT(text, Catch::Contains("acsd_robot_last_seen_seconds{robot=\"LR01\"} 3"));
    CHECK_THAT(text, Catch::Contains("acsd_robot_states_received_total{robot=\"LR01\"} 0"));
    CHECK_THAT(text, !Catch::Contains("acsd_arm_up{"));
}

TEST_CASE_METHOD(
    VehicleRobotFixture,
    "A vehicle shows what its messages contradict, and one with an arm whether the arm is ready")
{
    Connect();
    CHECK(robot.GetDetails().warnings.empty());
    CHECK_FALSE(robot.GetDetails().bArmUp.has_value());
    mqtt.listenerOrNull->OnMqttMessage(
        {"uagv/v2/ACS/LR01/connection",
         R"({"headerId":2,"timestamp":"2025-07-02T12:00:00.00Z","version":"2.1.0","manufacturer":"ACS",)"
         R"("serialNumber":"LR01","connectionState":"ONLINE"})",
         1,
         false});
    CHECK(robot.GetDetails().warnings.size() == 1);
    const VehicleRobot withArm(MakeServices(), FindVehicle("CR01"));
    CHECK(withArm.GetDetails().bArmUp == std::optional(false));
}

TEST_CASE_METHOD(VehicleRobotFixture, "A vehicle can be commanded before its start, as after a restart of acsd")
{
    VehicleRobot restored(MakeServices(), FindVehicle("LR01"));
    Planning::AdapterActions actions;
    restored.GetAdapter().Handle(Planning::RecoverJob{}, clock.GetNow(), actions);
    restored.OnAdapterCalled();
    mqtt.listenerOrNull = nullptr;
    restored.Start();
    CHECK(mqtt.listenerOrNull != nullptr);
}

} // namespace ACS::Acsd::Test

#include "robots/RobotHost.hpp"

#include "common/log/LogRateLimiter.hpp"
#include "config/ExampleSite.hpp"
#include "drivers/RecordingLink.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"

#include <boost/asio/io_context.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace ACS::Acsd::Test
{

namespace
{

/// The robot LR01 of the example site, whose vehicle goes online and offline.
struct RobotHostFixture
{
    static constexpr std::string_view UNSENT = "a message to the vehicle could not be sent";

    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    RecordingLink mqtt;
    Testing::RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    AcsdConfig config = ReadSite({});
    RobotHost host{
        {context.get_executor(), clock, random, mqtt, Core::Logger(log, "robot"), metrics},
        config,
        *std::ranges::find(config.robots, "LR01", &RobotLinkConfig::robotID),
        [](const std::string&, const Planning::RobotEvent&) {
        }};

    RobotHostFixture()
    {
        mqtt.bFails = true;
        host.Start();
    }

    void Connect()
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

TEST_CASE_METHOD(RobotHostFixture, "Messages that cannot be sent are logged at a limited rate")
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

} // namespace ACS::Acsd::Test

#include "robots/RetainedCommands.hpp"

#include "Catch.hpp"
#include "drivers/DriverMetrics.hpp"
#include "drivers/RecordingLink.hpp"
#include "RecordingLogSink.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

constexpr const char* ORDER = "uagv/v2/ACS/LR01/order";
constexpr const char* INSTANT_ACTIONS = "uagv/v2/ACS/LR01/instantActions";

struct RetainedCommandsFixture
{
    RecordingLink mqtt;
    Testing::RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    DriverMetrics ofRobot{metrics, "", "LR01"};
    RetainedCommands retained{{mqtt, Core::Logger(log, "robot"), ofRobot}, "LR01", {"uagv", "ACS", "LR01"}};

    [[nodiscard]] bool HasRemoved(int count) const
    {
        const std::string line =
            R"(acsd_retained_commands_removed_total{robot="LR01"} )" + std::to_string(count) + "\n";
        return metrics.Render().find(line) != std::string::npos;
    }
};

} // namespace

TEST_CASE_METHOD(RetainedCommandsFixture, "A retained message on a command topic is removed, counted and logged")
{
    const std::string topic = GENERATE(ORDER, INSTANT_ACTIONS);
    retained.OnLinkUp();
    CHECK(mqtt.filters == std::vector<std::string>{ORDER, INSTANT_ACTIONS});
    CHECK(retained.TryHandle({topic, R"({"orderId":"old"})", 1, true}));
    CHECK(mqtt.published == std::vector<VDA5050::MqttMessage>{{topic, "", 1, true}});
    CHECK(HasRemoved(1));
    REQUIRE(log.CountLevel(Core::ELogLevel::Warning) == 1);
    CHECK(log.ContainsField("topic", topic));
}

TEST_CASE_METHOD(
    RetainedCommandsFixture,
    "A message that is not retained, such as acsd's own, ends the subscription to its topic")
{
    retained.OnLinkUp();
    CHECK(retained.TryHandle({ORDER, R"({"orderId":"new"})", 2, false}));
    CHECK(mqtt.filters == std::vector<std::string>{INSTANT_ACTIONS});
    CHECK(retained.TryHandle({INSTANT_ACTIONS, "", 1, false})); // the removal itself
    CHECK(mqtt.filters.empty());
    CHECK(mqtt.published.empty());
    CHECK(log.GetLines().empty());
}

TEST_CASE_METHOD(
    RetainedCommandsFixture,
    "Each connection begins without the subscriptions of the one before, and makes them again")
{
    retained.OnLinkUp();
    retained.OnLinkDown();
    CHECK(mqtt.filters.empty());
    retained.OnLinkUp();
    CHECK(mqtt.filters.size() == 2);
}

TEST_CASE_METHOD(RetainedCommandsFixture, "A renewal subscribes again where the subscription has ended, and only there")
{
    retained.OnLinkUp();
    retained.Renew();
    CHECK(
        mqtt.filters
        == std::vector<std::string>{ORDER, INSTANT_ACTIONS}); // none again, which a broker may have refused
    CHECK(retained.TryHandle({ORDER, R"({"orderId":"new"})", 2, false}));
    CHECK(mqtt.filters == std::vector<std::string>{INSTANT_ACTIONS});
    retained.Renew();
    CHECK(mqtt.filters == std::vector<std::string>{INSTANT_ACTIONS, ORDER});
    retained.Renew();
    CHECK(mqtt.filters.size() == 2);
    CHECK(retained.TryHandle({ORDER, R"({"orderId":"left"})", 1, true}));
    CHECK(HasRemoved(1));
    CHECK(retained.TryHandle({ORDER, "", 1, false}));
    retained.OnLinkDown();
    retained.Renew();
    CHECK(mqtt.filters.empty());
}

TEST_CASE_METHOD(RetainedCommandsFixture, "Messages of other topics and of other vehicles are left alone")
{
    CHECK_FALSE(retained.TryHandle({"uagv/v2/ACS/LR01/connection", "{}", 1, true}));
    CHECK_FALSE(retained.TryHandle({"uagv/v2/ACS/LR02/order", "{}", 1, true}));
    CHECK(mqtt.published.empty());
}

TEST_CASE_METHOD(RetainedCommandsFixture, "A removal that cannot be sent is logged as an error and not counted")
{
    mqtt.bFails = true;
    CHECK(retained.TryHandle({ORDER, "{}", 1, true}));
    CHECK(log.CountLevel(Core::ELogLevel::Error) == 1);
    CHECK_FALSE(HasRemoved(1));
}

} // namespace ACS::Acsd::Test

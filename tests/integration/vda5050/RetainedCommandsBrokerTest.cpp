#include "Catch.hpp"
#include "common/http/MetricsEndpoint.hpp"
#include "drivers/DriverMetrics.hpp"
#include "LinkFixture.hpp"
#include "robots/RetainedCommands.hpp"

#include <memory>
#include <string>

namespace ACS::Testing
{
namespace
{

using VDA5050::MqttMessage;

constexpr const char* ORDER = "uagv/v2/ACS/LR01/order";
constexpr const char* ECHO_TOPIC = "test/echo";

/// A link with its own listener, and a way to see what a new subscriber receives.
struct RetainedBroker
{
    boost::asio::io_context context;
    MosquittoBroker broker{"allow_anonymous true\n"};
    TestLink acsd{context, MakeOptions(broker.GetPort(), "acsd")};
    TestLink other{context, MakeOptions(broker.GetPort(), "other")};
    RecordingLogSink log;
    Apps::MetricsEndpoint metrics;
    Acsd::DriverMetrics ofRobot{metrics, "", "LR01"};
    Acsd::RetainedCommands retained{{acsd.link, Core::Logger(log, "robot"), ofRobot}, "LR01", {"uagv", "ACS", "LR01"}};
    std::size_t handled = 0; ///< Of the messages that acsd has received.

    RetainedBroker()
    {
        for (TestLink* const started : {&acsd, &other})
        {
            started->link.Start();
            REQUIRE(TryRunUntil(context, [started] { return started->listener.ups == 1; }));
        }
        retained.OnLinkUp();
        AwaitSubscriptions();
    }

    /// The broker handles the packets of one connection in their order: the echo shows that earlier subscriptions are in effect.
    void AwaitSubscriptions()
    {
        acsd.link.Subscribe({{ECHO_TOPIC, 1}});
        REQUIRE(acsd.link.Publish({ECHO_TOPIC, {}, 1, false}).has_value());
        REQUIRE(TryRunUntil(context, [this] { return acsd.listener.CountTopic(ECHO_TOPIC) == 1; }));
        acsd.listener.messages.clear();
    }

    void Publish(const MqttMessage& message)
    {
        REQUIRE(other.link.Publish(message).has_value());
    }

    /// Passes on what acsd receives, until the condition holds.
    [[nodiscard]] bool TryHandleUntil(const std::function<bool()>& isTrue)
    {
        return TryRunUntil(context, [this, &isTrue] {
            for (; handled < acsd.listener.messages.size(); ++handled)
            {
                CHECK(retained.TryHandle(acsd.listener.messages[handled]));
            }
            return isTrue();
        });
    }

    [[nodiscard]] bool HasRemoved() const
    {
        return metrics.Render().find(R"(acsd_retained_commands_removed_total{robot="LR01"} 1)") != std::string::npos;
    }

    /// What a vehicle receives that connects now; the last message shows the end of what was retained.
    [[nodiscard]] std::vector<std::string> ListLeft()
    {
        TestLink vehicle(context, MakeOptions(broker.GetPort(), "vehicle"));
        vehicle.link.Subscribe({{"uagv/v2/ACS/LR01/#", 1}});
        vehicle.link.Start();
        REQUIRE(TryRunUntil(context, [&vehicle] { return vehicle.listener.ups == 1; }));
        Publish({"uagv/v2/ACS/LR01/end", "end", 1, false});
        REQUIRE(TryRunUntil(context, [&vehicle] { return vehicle.listener.CountTopic("uagv/v2/ACS/LR01/end") == 1; }));
        std::vector<std::string> payloads;
        for (const MqttMessage& message : vehicle.listener.messages)
        {
            payloads.push_back(message.payload);
        }
        return payloads;
    }
};

} // namespace

TEST_CASE_METHOD(
    RetainedBroker,
    "A command that another program retains while acsd is connected is removed by the next renewal")
{
    Publish({ORDER, "left", 1, true});
    REQUIRE(TryHandleUntil([this] { return handled == 1; }));
    CHECK_FALSE(acsd.listener.messages.front().bRetained); // the broker marks it for later subscriptions only
    CHECK_FALSE(HasRemoved());
    CHECK(ListLeft() == std::vector<std::string>{"left", "end"});
    retained.Renew();
    REQUIRE(TryHandleUntil([this] { return handled == 3; })); // the message, and its removal
    CHECK(HasRemoved());
    CHECK(ListLeft() == std::vector<std::string>{"end"});
}

} // namespace ACS::Testing

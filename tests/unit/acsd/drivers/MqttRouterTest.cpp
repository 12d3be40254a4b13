#include "drivers/MqttRouter.hpp"

#include "Catch.hpp"
#include "drivers/RecordingLink.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using Lines = std::vector<std::string>;

/// Records what it receives. May end its service at the first message.
class RecordingListener final : public VDA5050::IMqttLinkListener
{
public:
    Lines received;
    IMqttService* endedOrNull = nullptr;

    void OnLinkUp() override
    {
        received.emplace_back("up");
    }

    void OnLinkDown(std::error_code reason) override
    {
        received.push_back("down: " + reason.message());
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        received.push_back(message.topic + " " + message.payload);
        if (endedOrNull != nullptr)
        {
            endedOrNull->SetListener(nullptr);
            endedOrNull->Unsubscribe(message.topic);
        }
    }
};

/// Each message takes 5 ms.
class SlowLink final : public VDA5050::IMqttLink
{
    Testing::ManualClock& _clock;

public:
    explicit SlowLink(Testing::ManualClock& clock)
        : _clock(clock)
    {
    }

    [[nodiscard]] Core::Result<void> Publish(const VDA5050::MqttMessage& /*message*/) override
    {
        _clock.Advance(std::chrono::milliseconds(5));
        return {};
    }

    void Subscribe(const std::vector<VDA5050::MqttSubscription>& /*subscriptions*/) override
    {
    }

    void Unsubscribe(const std::string& /*topicFilter*/) override
    {
    }
};

struct MqttRouterFixture
{
    Testing::TemporaryFolder folder;
    Testing::ManualClock clock;
    Testing::RecordingLogSink log;
    std::unique_ptr<MessageTrace> trace =
        std::move(*MessageTrace::Create(folder.GetPath().string(), {}, clock, Core::Logger(log, "trace")));
    RecordingLink link;
    Lines states; ///< Of the connection, as acsd itself receives them.
    bool bClosed = false;
    bool bLeads = true;
    MqttRouter router{
        {Core::Logger(log, "mqtt"),
         trace.get(),
         [this](bool bUp) { states.emplace_back(bUp ? "up" : "down"); },
         [this] { return bClosed; },
         [this] {
             return bLeads;
         }}};
    std::unique_ptr<IMqttService> first = router.MakeService("LR01", "uagv/v2/ACS/LR01");
    std::unique_ptr<IMqttService> second = router.MakeService("LR02", "carts/2");
    RecordingListener firstListener;
    RecordingListener secondListener;

    MqttRouterFixture()
    {
        router.SetLink(link);
        first->SetListener(&firstListener);
        second->SetListener(&secondListener);
    }

    [[nodiscard]] std::string GetTrace() const
    {
        return trace->GetNewest().GetText(100);
    }
};

} // namespace

TEST_CASE_METHOD(MqttRouterFixture, "A message is passed to the robot whose topics begin like its topic")
{
    router.OnMqttMessage({"uagv/v2/ACS/LR01/state", "a", 0, false});
    router.OnMqttMessage({"carts/2/a/long/topic/of/the/robot", "b", 0, false});
    router.OnMqttMessage({"carts/2", "c", 0, false});
    CHECK(firstListener.received == Lines{"uagv/v2/ACS/LR01/state a"});
    CHECK(secondListener.received == Lines{"carts/2/a/long/topic/of/the/robot b", "carts/2 c"});
}

TEST_CASE_METHOD(MqttRouterFixture, "A message on an unknown topic is passed to no robot")
{
    for (const char* topic :
         {"", "/", "carts", "carts/", "carts/20", "carts/22/x", "/carts/2", "x/carts/2", "uagv/v2/ACS"})
    {
        router.OnMqttMessage({topic, "x", 0, false});
    }
    CHECK(firstListener.received.empty());
    CHECK(secondListener.received.empty());
}

TEST_CASE_METHOD(
    MqttRouterFixture,
    "Of two robots whose topics begin alike, the one with the longer prefix receives the message")
{
    const std::unique_ptr<IMqttService> inner = router.MakeService("LR03", "carts/2/trailer");
    RecordingListener innerListener;
    inner->SetListener(&innerListener);
    router.OnMqttMessage({"carts/2/trailer/state", "a", 0, false});
    router.OnMqttMessage({"carts/2/trailers", "b", 0, false});
    CHECK(innerListener.received == Lines{"carts/2/trailer/state a"});
    CHECK(secondListener.received == Lines{"carts/2/trailers b"});
}

TEST_CASE_METHOD(MqttRouterFixture, "A prefix may begin or end with an empty level")
{
    const std::unique_ptr<IMqttService> odd = router.MakeService("LR03", "/cart/");
    RecordingListener oddListener;
    odd->SetListener(&oddListener);
    router.OnMqttMessage({"/cart//state", "a", 0, false});
    router.OnMqttMessage({"/cart", "b", 0, false});
    CHECK(oddListener.received == Lines{"/cart//state a"});
}

TEST_CASE_METHOD(MqttRouterFixture, "Every robot receives each state of the connection, after acsd itself")
{
    router.OnLinkUp();
    router.OnLinkDown(std::make_error_code(std::errc::connection_reset));
    const std::string lost = "down: " + std::make_error_code(std::errc::connection_reset).message();
    CHECK(states == Lines{"up", "down"});
    CHECK(firstListener.received == Lines{"up", lost});
    CHECK(secondListener.received == Lines{"up", lost});
}

TEST_CASE_METHOD(MqttRouterFixture, "A listener that ends in a call receives nothing more; the other robots do")
{
    firstListener.endedOrNull = first.get();
    first->Subscribe({{"uagv/v2/ACS/LR01/state", 1}});
    router.OnMqttMessage({"uagv/v2/ACS/LR01/state", "a", 0, false});
    router.OnMqttMessage({"uagv/v2/ACS/LR01/state", "b", 0, false});
    router.OnLinkDown({});
    router.OnLinkUp();
    CHECK(firstListener.received == Lines{"uagv/v2/ACS/LR01/state a"});
    CHECK(secondListener.received.size() == 2);
    CHECK(link.filters.empty());
}

TEST_CASE_METHOD(MqttRouterFixture, "A robot whose service is gone receives nothing, and its topics can be used again")
{
    second.reset();
    router.OnMqttMessage({"carts/2/state", "a", 0, false});
    router.OnLinkUp();
    CHECK(secondListener.received.empty());
    second = router.MakeService("LR02", "carts/2");
    second->SetListener(&firstListener);
    router.OnMqttMessage({"carts/2/state", "b", 0, false});
    CHECK(firstListener.received == Lines{"up", "carts/2/state b"});
}

TEST_CASE_METHOD(
    MqttRouterFixture,
    "While acsd closes, the robots receive nothing, and acsd still the states of the connection")
{
    bClosed = true;
    router.OnLinkUp();
    router.OnMqttMessage({"carts/2/state", "a", 0, false});
    router.OnLinkDown({});
    CHECK(states == Lines{"up", "down"});
    CHECK(secondListener.received.empty());
    CHECK(GetTrace().empty());
}

TEST_CASE_METHOD(MqttRouterFixture, "Subscriptions are made on the connection, but not outside of the robot's topics")
{
    second->Subscribe({{"carts/2/state", 1}, {"carts/2/#", 0}, {"carts/+/state", 0}, {"carts/20/state", 0}, {"#", 0}});
    CHECK(link.filters == Lines{"carts/2/state", "carts/2/#"});
    CHECK(log.CountLevel(Core::ELogLevel::Error) == 3);
    CHECK(log.ContainsField("topic", "carts/+/state"));
    first->Unsubscribe("carts/2/#"); // of another robot
    CHECK(link.filters.size() == 2);
    second->Unsubscribe("carts/2/#");
    CHECK(link.filters == Lines{"carts/2/state"});
}

TEST_CASE_METHOD(MqttRouterFixture, "A message is published on the connection; its failure is the robot's to handle")
{
    const VDA5050::MqttMessage message{"anywhere/else", "go", 1, true};
    CHECK(first->Publish(message).has_value());
    CHECK(link.published == std::vector<VDA5050::MqttMessage>{message});
    link.bFails = true;
    const Core::Result<void> failed = first->Publish(message);
    REQUIRE_FALSE(failed.has_value());
    CHECK(failed.error().code == std::errc::not_connected);
}

TEST_CASE_METHOD(MqttRouterFixture, "A process that does not lead publishes nothing")
{
    bLeads = false;
    CHECK_FALSE(first->Publish({"uagv/v2/ACS/LR01/order", "go", 1, false}).has_value());
    CHECK(link.published.empty());
}

TEST_CASE_METHOD(MqttRouterFixture, "The trace has every message with its robot, also those of unknown robots")
{
    const Core::Now now = clock.GetNow();
    using ProtocolBeast::EWireDirection;
    router.OnMqttMessage({"carts/2/state", "in", 0, false});
    router.OnMqttMessage({"carts/3/state", "other", 0, false});
    CHECK(second->Publish({"carts/2/order", "out", 0, false}).has_value());
    link.bFails = true;
    CHECK_FALSE(second->Publish({"carts/2/order", "lost", 0, false}).has_value());
    CHECK(
        GetTrace()
        == MakeTraceLine({"mqtt", EWireDirection::In, "LR02", "carts/2/state", "in"}, now) + "\n"
            + MakeTraceLine({"mqtt", EWireDirection::In, "", "carts/3/state", "other"}, now) + "\n"
            + MakeTraceLine({"mqtt", EWireDirection::Out, "LR02", "carts/2/order", "out"}, now) + "\n");
}

TEST_CASE_METHOD(MqttRouterFixture, "The time of a message in the trace is before its receiver can have it")
{
    const Core::Now now = clock.GetNow();
    SlowLink slow(clock);
    router.SetLink(slow);
    CHECK(second->Publish({"carts/2/order", "out", 0, false}).has_value());
    using ProtocolBeast::EWireDirection;
    CHECK(GetTrace() == MakeTraceLine({"mqtt", EWireDirection::Out, "LR02", "carts/2/order", "out"}, now) + "\n");
    router.SetLink(link);
}

} // namespace ACS::Acsd::Test
